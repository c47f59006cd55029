#include "mc/study/design.hpp"

#include <bit>
#include <boost/random/sobol.hpp>
#include <cmath>

#include "core/stats/normal.hpp"

namespace drift::mc {
namespace {

std::uint32_t index_of(std::size_t param) {
  return stream_index(TermLibrary::specs[param].key);
}

/// 53 bits as a number inside (0, 1).
double inside_unit(std::uint64_t bits) {
  return (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53;
}

double at_quantile(const Prior& prior, double u) {
  switch (prior.kind) {
    case Prior::Kind::normal:
      return prior.a + prior.b * stats::normal_quantile(u);
    case Prior::Kind::uniform:
      return prior.a + (prior.b - prior.a) * u;
    case Prior::Kind::fixed:
      break;
  }
  return prior.a;
}

bool distributed(const ModelSpec& spec, std::size_t param) {
  return spec.active[param] && spec.priors[param].kind != Prior::Kind::fixed;
}

}  // namespace

std::uint64_t permuted(std::uint64_t k, std::uint64_t n, std::uint64_t seed, std::uint32_t index) {
  if (n <= 1) return 0;
  const auto half_bits = static_cast<int>((std::bit_width(n - 1) + 1) / 2);
  const std::uint64_t mask = (std::uint64_t{1} << half_bits) - 1;
  do {
    std::uint64_t left = k >> half_bits, right = k & mask;
    for (std::uint64_t round = 1; round <= 8; ++round) {
      // Rounds stand above the 32 bits of a half; round 0 is left to draws inside strata.
      Stream stream(seed, round << 32 | right, Purpose::design, index);
      const auto f = static_cast<std::uint64_t>(stream.uniform() * 0x1p53) & mask;
      const std::uint64_t next = left ^ f;
      left = right;
      right = next;
    }
    k = left << half_bits | right;
  } while (k >= n);
  return k;
}

struct Design::Sobol {
  boost::random::sobol engine;
  std::vector<std::uint64_t> shift, point;
  explicit Sobol(std::size_t dimensions) : engine(dimensions), point(dimensions) {}

  void move_to(std::uint64_t run) {
    // Boost leaves out the first point of the sequence, zero; without it, equal intervals are
    // missed.
    if (run > 0) {
      engine.seed();
      engine.discard((run - 1) * point.size());
    }
    for (std::size_t d = 0; d < point.size(); ++d) point[d] = (run > 0 ? engine() : 0) ^ shift[d];
  }
};

Design::Design(const TruthSpec& truth, DesignKind kind, std::uint64_t runs, std::uint64_t seed)
    : truth_(truth), kind_(kind), runs_(runs), seed_(seed) {
  if (kind != DesignKind::sobol) return;
  std::vector<std::uint64_t> shift;
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i) {
    if (!distributed(truth_, i)) continue;
    Stream stream(seed, 0, Purpose::design, index_of(i));
    shift.push_back(static_cast<std::uint64_t>(stream.uniform() * 0x1p53) << 11);
  }
  if (shift.empty()) return;
  sobol_ = std::make_unique<Sobol>(shift.size());
  sobol_->shift = std::move(shift);
}

Design::~Design() = default;
Design::Design(Design&&) noexcept = default;

double Design::uniform(std::uint64_t run, std::size_t param) const {
  const std::uint32_t index = index_of(param);
  const std::uint64_t cube = run / runs_;
  const std::uint64_t cube_seed = seed_ + cube * 0x9E3779B97F4A7C15u;
  const std::uint64_t stratum = permuted(run % runs_, runs_, cube_seed, index);
  Stream stream(seed_, run, Purpose::design, index);
  const double u = (static_cast<double>(stratum) + stream.uniform()) / static_cast<double>(runs_);
  return std::min(u, 1.0 - 0x1p-53);  // rounding may carry the last stratum to 1
}

TruthDraw Design::draw(std::uint64_t run, int chains) {
  TruthDraw out;
  draw(run, chains, out);
  return out;
}

void Design::draw(std::uint64_t run, int chains, TruthDraw& out) {
  out.theta = draw_parameters(truth_, seed_, run, Purpose::parameters);
  draw_attitudes(truth_, chains, seed_, run, out.psi0_l);
  if (kind_ == DesignKind::random) return;
  if (sobol_) sobol_->move_to(run);
  std::size_t dimension = 0;
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i) {
    if (!distributed(truth_, i)) continue;
    const double u = sobol_ ? inside_unit(sobol_->point[dimension++]) : uniform(run, i);
    out.theta[i] = at_quantile(truth_.priors[i], u);
  }
}

}  // namespace drift::mc
