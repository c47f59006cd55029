#include "analysis/report/page/wording.hpp"

namespace drift::report {

std::string parameter_key(std::size_t param) {
  return std::string(TermLibrary::specs[param].key.view());
}

std::string parameter_key(const Layout& layout, std::size_t state) {
  return parameter_key(layout.params[state]);
}

std::string parameter_unit(std::size_t param) {
  return std::string(TermLibrary::specs[param].unit.symbol.view());
}

double unit_of(std::size_t param) {
  return TermLibrary::specs[param].unit.to_si;
}

Cell parameter_cell(std::size_t param) {
  return {parameter_key(param),
          fmt::format("{} [{}]", parameter_key(param), parameter_unit(param))};
}

std::string_view plural(std::size_t count) {
  return count == 1 ? "" : "s";
}

}  // namespace drift::report
