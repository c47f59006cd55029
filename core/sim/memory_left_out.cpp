#include "core/sim/memory_left_out.hpp"

#include <algorithm>
#include <cmath>

namespace drift {

std::vector<MemoryLeftOut> memory_left_out(const Timeline& timeline, const DriftModel& model,
                                           const Theta& theta, const std::vector<Vec3>& psi0_l) {
  // A memory is of order 1 where its term acts; less is nothing, and may be the error of a step.
  constexpr double nothing = 1e-3;
  if (!TermLibrary::remember(model.terms)) return {};
  std::array<double, num_memory> along_nominal{}, along_own{}, apart{};  // squares over time
  double seconds = 0.0;
  MemoryPath own(timeline, model);
  walk(timeline, model, theta, psi0_l,
       [&](std::size_t n, const std::vector<Vec3>& phi, const MemoryPath& nominal) {
         own.advance_along(n, theta.data(), phi.data());
         const Interval& i = timeline.intervals[n];
         const std::size_t steps = 2 * (i.node_count() - 1);
         const double dt = i.length() / static_cast<double>(steps);
         for (std::size_t k = 1; k <= steps; ++k)
           for (std::size_t m = 0; m < num_memory; ++m) {
             const double a = nominal.itself()[k].value[m], b = own.itself()[k].value[m];
             along_nominal[m] += a * a * dt;
             along_own[m] += b * b * dt;
             apart[m] += (b - a) * (b - a) * dt;
           }
         seconds += i.length();
       });
  std::vector<MemoryLeftOut> all;
  TermLibrary::for_each_memory(model.terms, [&]<class T>(const TermInfo& term) {
    MemoryLeftOut one{term.key};
    for (int k = term.first_memory; k < term.first_memory + term.memory; ++k) {
      const auto m = static_cast<std::size_t>(k);
      const double whole = std::max(along_nominal[m], along_own[m]);
      if (whole > nothing * nothing * seconds)
        one.part = std::max(one.part, std::sqrt(apart[m] / whole));
    }
    all.push_back(one);
  });
  return all;
}

}  // namespace drift
