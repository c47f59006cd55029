#include "core/estimate/batch_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/estimate/random_walk.hpp"
#include "core/estimate/triangle.hpp"
#include "core/physics/closure.hpp"

namespace drift {

double Evaluation::data_cost() const {
  double sum = left_over;
  for (const auto& c : rows) sum += c.rows.rightCols<1>().squaredNorm();
  return sum;
}

BatchEquations compressed(const Evaluation& e) {
  BatchEquations out{{}, e.psi, e.x};
  for (const auto& c : e.rows) out.chains.push_back(triangle(c.rows));
  return out;
}

template <class Test>
RowsAlongPath::RowsAlongPath(const Test& test, const Timeline& timeline, const FilterSpec& filter)
    : timeline_(timeline),
      model_(filter.model()),
      equations_(test, model_, make_layout(filter), filter.initial_attitude),
      lanes_(timeline, model_),
      in_lanes_(all_in_lanes(model_.terms)),
      phi_(timeline.nodes.size(), Vec3::Zero()) {}

std::vector<ChainEquations> RowsAlongPath::at(const Theta& theta, const std::vector<Vec3>& psi0_l) {
  if (in_lanes_) {
    lanes_.set_theta(theta);
    lanes_.all_forward(psi0_l, phi_.data());
  } else {
    phi_ = integrate_fixed(timeline_, model_, theta, psi0_l);
  }
  return equations_.at(theta, phi_);
}

BatchProblem::BatchProblem(const FilterSpec& filter, const MeasuredTest& test)
    : filter_(filter),
      test_(test),
      samples_(test_, test_.timeline, filter_),
      sigma_psi_(filter.initial_attitude),
      angle_random_walk_(filter.noise.angle_random_walk) {
  if (!walks() && CompressedTest::can(filter.model())) compress();
}

void BatchProblem::compress() {
  compressed_ = std::make_unique<CompressedTest>(test_.timeline, test_.readout,
                                                 CompressedTest::Options{.leave = left_alone_});
  if (!compressed_->any()) return take_every_sample();
  compressed_->read(test_.measured);
  stretches_ = std::make_unique<RowsAlongPath>(*compressed_, compressed_->timeline(), filter_);
}

void BatchProblem::take_every_sample() {
  stretches_.reset();
  compressed_.reset();
}

bool BatchProblem::jumps() const {
  return std::ranges::any_of(layout().params, [](std::size_t i) {
    return TermLibrary::specs[i].kind == ParamKind::moment;
  });
}

std::optional<Eigen::Index> BatchProblem::multiplier() const {
  const auto& params = layout().params;
  const auto at = std::ranges::find(params, closure_param);
  if (at == params.end()) return {};
  return at - params.begin();
}

std::vector<double> BatchProblem::both_equations() const {
  std::vector<double> values;
  Theta theta = layout().theta;
  for (const Coupling c : {Coupling::eq5, Coupling::eq6}) {
    theta[closure_param] = facts(c).lambda.value();
    values.push_back(layout().scaled(theta)[*multiplier()]);
  }
  return values;
}

std::vector<Vec3> BatchProblem::scaled(const std::vector<Vec3>& psi0_l) const {
  std::vector<Vec3> psi;
  for (const Vec3& p : psi0_l) psi.push_back(p / sigma_psi_);
  return psi;
}

std::vector<Vec3> BatchProblem::unscaled(const std::vector<Vec3>& psi) const {
  std::vector<Vec3> psi_l;
  for (const Vec3& p : psi) psi_l.push_back(sigma_psi_ * p);
  return psi_l;
}

std::vector<ChainEquations> BatchProblem::rows_at(const VecX& x, const std::vector<Vec3>& psi) {
  const Theta theta = layout().theta_at(x);
  const std::vector<Vec3> psi0_l = unscaled(psi);
  while (compressed()) {
    std::vector<ChainEquations> rows = stretches_->at(theta, psi0_l);
    if (stretches_->too_rough().empty()) return rows;
    for (const std::size_t i : stretches_->too_rough())
      left_alone_.push_back(compressed_->first(i));
    compress();
  }
  return samples_.at(theta, psi0_l);
}

void BatchProblem::whiten_at(const VecX& x, const std::vector<Vec3>& psi) {
  if (walks()) white_at_ = attitude_columns(rows_at(x, psi));
}

Evaluation BatchProblem::evaluate(VecX x, std::vector<Vec3> psi) {
  std::vector<ChainEquations> rows = rows_at(x, psi);
  Evaluation e{std::move(x), std::move(psi), std::move(rows), 0.0,
               compressed() ? compressed_->left_over() : 0.0};
  if (walks()) whiten_random_walk(test_, angle_random_walk_, sigma_psi_, white_at_, e.rows);
  e.cost = e.data_cost() + e.x.squaredNorm();
  for (const Vec3& p : e.psi) e.cost += p.squaredNorm();
  if (!std::isfinite(e.cost)) e.cost = std::numeric_limits<double>::infinity();
  return e;
}

}  // namespace drift
