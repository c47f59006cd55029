#include "core/physics/own/own_scenes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/base/rng.hpp"
#include "core/physics/expression/evaluate.hpp"
#include "core/physics/own/own_inputs.hpp"
#include "core/physics/own/own_terms.hpp"
#include "core/physics/term_library.hpp"

namespace drift {
namespace {

using Slope = Dual<1>;

/// Scene number k: some with as much as possible at zero or along an axis, the rest anywhere.
std::vector<double> own_scene(std::uint64_t k, std::size_t inputs) {
  Stream stream(1, k, Purpose::test);
  const auto spread = [&](double size) {
    return k < 12 ? 0.0 : size * (2.0 * stream.uniform() - 1.0);
  };
  Vec3 f = k < 6 ? Vec3(k % 2 ? -Vec3::Unit(k / 2) : Vec3(Vec3::Unit(k / 2)))
                 : Vec3{stream.normal(), stream.normal(), stream.normal()}.normalized();
  constexpr double times[] = {0.0, 60.0, 3600.0, 86400.0};  // [s]
  const double t = times[k % 4], t_position = k % 3 ? std::min(t, 1800.0) : 0.0;
  std::vector<double> values{t, t_position, f[0], f[1], f[2], f[0], f[1], f[2]};
  for (int i = 0; i < 3; ++i) values.push_back(spread(8e-5));  // [rad/s] of the case
  for (int i = 0; i < 3; ++i) values.push_back(spread(5e-3));  // [rad/s] commanded
  for (int i = 0; i < 3; ++i) values.push_back(spread(3.0));   // [rad] of the gimbals
  for (const OwnInput& in : own_inputs)
    if (const CovariateSpec* c = in.covariate) {
      constexpr double rate = 1e-4;  // [1/s]: all of it in three hours
      const double usual = c->usual * c->unit.to_si;
      values.push_back(spread(c->is_vector() || in.part == 0 ? usual : rate * usual));
    }
  while (values.size() < inputs) values.push_back(1.0 + stream.uniform());
  return values;
}

/// The parameters, each of whose grids is at its value number k.
std::vector<double> parameter_values(const std::vector<ParamSpec>& params, std::size_t k) {
  std::vector<double> values;
  for (const ParamSpec& spec : params) {
    const Prior prior = spec.prior_si();
    values.push_back(spec.amplitude()      ? prior.mean() + prior.sigma()
                     : k == 0              ? prior.mean()
                     : k <= spec.grid.size ? spec.grid.values[k - 1] * spec.unit.to_si
                                           : prior.mean());
  }
  return values;
}

/// The value of a program and its slope in one input (or none).
Slope program_at(const EquationProgram& program, const std::vector<double>& inputs,
                 const std::vector<double>& params, std::size_t variable) {
  std::vector<Slope> p(params.begin(), params.end());
  return evaluate_program(program, p.data(), [&](int index) {
    Slope x(inputs[static_cast<std::size_t>(index)]);
    if (static_cast<std::size_t>(index) == variable) x.d[0] = 1.0;
    return x;
  });
}

/// "t = 0, f_x = 1": what a program reads.
std::string inputs_told(const EquationProgram& program, const std::vector<double>& values,
                        const std::vector<std::string>& names) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t k = 0; k < program.size; ++k)
      if (program.code[k].op == Operation::input &&
          program.code[k].index == static_cast<std::int16_t>(i)) {
        parts.push_back(fmt::format("{} = {:.3g}", names[i], values[i]));
        break;
      }
  return parts.empty() ? "anywhere" : fmt::format("where {}", fmt::join(parts, ", "));
}

}  // namespace

namespace {

/// Whether the value follows a parameter otherwise than through `step` or `sign`.
bool is_outside_steps(const EquationProgram& program, std::size_t param) {
  std::vector<bool> follows;  // what is on the stack
  for (std::size_t k = 0; k < program.size; ++k) {
    const Instruction& i = program.code[k];
    const int operands = operands_of(i.op);
    bool any = i.op == Operation::parameter && static_cast<std::size_t>(i.index) == param;
    for (int n = 0; n < operands; ++n) {
      any = any || follows.back();
      follows.pop_back();
    }
    follows.push_back(any && i.op != Operation::step && i.op != Operation::sign);
  }
  return follows.back();
}

bool has_power(const EquationProgram& program) {
  return std::any_of(program.code.begin(),
                     program.code.begin() + static_cast<std::ptrdiff_t>(program.size),
                     [](const Instruction& i) { return i.op == Operation::power; });
}

}  // namespace

std::optional<EquationMistake> mistake_in_scenes(const EquationProgram& program,
                                                 const std::vector<ParamSpec>& params,
                                                 const std::vector<std::string>& inputs) {
  constexpr std::uint64_t scenes = 100;
  for (std::uint64_t k = 0; k < scenes; ++k)
    for (std::size_t grid = 0; grid <= (k < 12 ? Grid::capacity : 0); ++grid) {
      const auto values = own_scene(k, inputs.size());
      const auto p = parameter_values(params, grid);
      for (std::size_t variable = 0; variable < inputs.size(); ++variable) {
        const Slope y = program_at(program, values, p, variable);
        if (std::isfinite(y.v) && std::isfinite(y.d[0])) continue;
        const bool number = std::isfinite(y.v);
        return EquationMistake{
            0,
            fmt::format("{} {} (in rad, s, g, K, T)",
                        number ? fmt::format("has no finite slope in {}", inputs[variable])
                               : "is not a number",
                        inputs_told(program, values, inputs)),
            "a finite number with a finite slope wherever the platform may be",
            has_power(program)
                ? "An exponent that is not a whole number of at most 100 in figures is "
                  "of a base that is not negative: abs(x)^N, sqrt(max(x, 0.01))"
                : "Keep divisors, logarithms and roots away from zero, as with "
                  "max(x, 0.01)"};
      }
    }
  return std::nullopt;
}

bool has_slope(std::size_t param) {
  for (std::size_t own = 0; own < own_terms().terms.size(); ++own) {
    const OwnTerm& term = own_terms().terms[own];
    const std::size_t first = TermLibrary::terms[TermLibrary::num_known + own].first;
    if (param >= first && param < first + term.params.size())
      return is_outside_steps(term.program, param - first);
  }
  return true;
}

}  // namespace drift
