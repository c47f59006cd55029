#include "core/base/build_info.hpp"

#include <fmt/format.h>

#include <build_commit.hpp>  // made by the build
#include <cmath>
#include <sstream>

#include "core/base/sha256.hpp"

namespace drift {
namespace {

const char* instruction_set() {
#if defined(__AVX512F__)
  return "x86-64 with AVX-512";
#elif defined(__AVX2__) && defined(__FMA__)
  return "x86-64 with AVX2 and FMA";
#elif defined(__x86_64__)
  return "x86-64";
#else
  return "generic";
#endif
}

/// "name=version|name=version" as the build passes it; what has no version is absent.
std::vector<std::pair<std::string, std::string>> parse_list(const char* text) {
  std::vector<std::pair<std::string, std::string>> list;
  std::istringstream items(text);
  for (std::string item; std::getline(items, item, '|');) {
    const auto equals = item.find('=');
    if (equals != std::string::npos && equals + 1 < item.size())
      list.emplace_back(item.substr(0, equals), item.substr(equals + 1));
  }
  return list;
}

std::string compute_fingerprint() {
  constexpr int samples = 2000;
  std::vector<double> values;
  values.reserve(std::size_t{6} * samples);
  for (int i = 1; i <= samples; ++i) {
    const volatile double x = 0.0137 * i;  // volatile: computed when the program runs
    const volatile double y = 0.71 + 1e-3 * i;
    values.insert(values.end(), {std::exp(x), std::log(x), std::sin(x), std::cos(x),
                                 std::atan2(x, y), std::pow(y, x)});
  }
  Sha256 hash;
  hash.update(std::span<const double>(values));
  return to_hex(hash.finish()).substr(0, 12);
}

}  // namespace

const BuildInfo& build_info() {
  static const BuildInfo info{DRIFT_VERSION,
                              DRIFT_COMMIT,
                              DRIFT_BUILD_TYPE,
                              fmt::format("{} {}", DRIFT_COMPILER, __VERSION__),
                              DRIFT_FLAGS,
                              instruction_set(),
                              parse_list(DRIFT_LIBRARIES)};
  return info;
}

const std::string& arithmetic_fingerprint() {
  static const std::string digits = compute_fingerprint();
  return digits;
}

}  // namespace drift
