#include "analysis/strapdown/consumer_grade.hpp"

#include <algorithm>
#include <string_view>

namespace drift::strapdown {
namespace {

constexpr double beyond_data_sheets = 100.0;

struct OfDataSheets {
  std::string_view group;
  double sigma;  ///< SI
};

constexpr double percent = 0.01, deg_per_s = detail::deg;
constexpr double degrees = 30.0;  ///< half a data sheet's range of temperature

constexpr OfDataSheets data_sheets[] = {
    {"D_F", 20.0 * deg_per_s},
    {"D_I", 0.1 * deg_per_s},
    {"D_O", 0.1 * deg_per_s},
    {"D_S", 0.1 * deg_per_s},
    {"D_II", 0.01 * deg_per_s},
    {"D_OO", 0.01 * deg_per_s},
    {"D_SS", 0.01 * deg_per_s},
    {"D_IO", 0.01 * deg_per_s},
    {"D_IS", 0.01 * deg_per_s},
    {"D_OS", 0.01 * deg_per_s},
    {"s", 3.0 * percent},
    {"eta", 2.0 * percent},
    {"xi", 2.0 * percent},
    {"K0", 0.1},
    {"K1", 3.0 * percent},
    {"K2", 0.5 * percent},
    {"K3", 0.5 * percent},
    {"K_ip", 0.5 * percent},
    {"dP", 2.0 * percent},
    {"dO", 2.0 * percent},
    // 0.01 to 0.05 deg/s per degree; of higher orders as much at 30 degrees from the mean.
    {"kT", 0.03 * deg_per_s},
    {"kT2", 0.03 * deg_per_s / degrees},
    {"kT3", 0.03 * deg_per_s / (degrees * degrees)},
};

bool same(const Prior& a, const Prior& b) {
  return a.kind == b.kind && a.mean() == b.mean() && a.sigma() == b.sigma();
}

}  // namespace

Prior consumer_prior(std::size_t param) {
  const ParamSpec& spec = TermLibrary::specs[param];
  const Prior library = spec.prior_si();
  if (!spec.amplitude() || library.kind != Prior::Kind::normal) return library;
  const auto known = std::ranges::find(data_sheets, spec.group.view(), &OfDataSheets::group);
  return normal(library.mean(), known != std::end(data_sheets)
                                    ? known->sigma
                                    : beyond_data_sheets * library.sigma());
}

void take_consumer_priors(FilterSpec& filter) {
  for (std::size_t p = 0; p < TermLibrary::num_params; ++p) {
    const Prior library = TermLibrary::specs[p].prior_si();
    // An effect that is not in the filter has no prior of its own.
    if (!filter.active[p] || same(filter.priors[p], library)) filter.priors[p] = consumer_prior(p);
  }
}

}  // namespace drift::strapdown
