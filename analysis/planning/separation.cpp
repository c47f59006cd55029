#include "analysis/planning/separation.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/inference/projector.hpp"
#include "core/base/decompose.hpp"

namespace drift::planning {

Information& Information::operator+=(const Information& o) {
  tt += o.tt;
  te += o.te;
  ee += o.ee;
  return *this;
}

Information information_of(const inference::LinearProblem& problem,
                           const inference::NoiseModel& noise) {
  const inference::Projector p(problem, noise);
  return {p.theta().transpose() * p.theta(), p.theta().transpose() * p.extra(),
          p.extra().transpose() * p.extra()};
}

std::vector<Separation> separations(const Information& info, std::span<const Trace> traces,
                                    std::span<const Contest> pairs) {
  const MatX A = info.tt + MatX::Identity(info.tt.rows(), info.tt.cols());
  const MatX C = info.ee - info.te.transpose() * Cholesky(A).solve(info.te);
  std::vector<Separation> out;
  for (const Contest& pair : pairs) {
    const Trace &c = traces[pair.truth], &d = traces[pair.rival];
    const MatX cc = C(c.columns, c.columns);
    const auto size = [&](const MatX& m) {
      return std::max(0.0, c.amplitude.dot(m * c.amplitude));
    };
    const double whole = size(cc);
    Separation s;
    s.alone = std::sqrt(whole);
    if (d.columns.empty()) {
      const double raw = size(info.ee(c.columns, c.columns));
      s.sigma = s.alone;
      s.unlike = raw > 0.0 ? whole / raw : 0.0;
    } else {
      const MatX cd = C(c.columns, d.columns);
      MatX dd = C(d.columns, d.columns);
      s.unlike =
          whole > 0.0 ? size(cc - cd * solve_least_squares(dd, cd.transpose())) / whole : 0.0;
      dd.diagonal().array() += 1.0;
      s.sigma = std::sqrt(size(cc - cd * Cholesky(dd).solve(MatX(cd.transpose()))));
    }
    out.push_back(s);
  }
  return out;
}

}  // namespace drift::planning
