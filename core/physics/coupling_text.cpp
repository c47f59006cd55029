#include "core/physics/coupling_text.hpp"

namespace drift {

std::string_view key_of(Coupling coupling) {
  switch (coupling) {
    case Coupling::eq5:
      return "eq5";
    case Coupling::eq6:
      return "eq6";
    case Coupling::lambda:
      return "lambda";
    case Coupling::compensated:
      return "compensated";
    case Coupling::servo:
      return "servo";
  }
  return "";
}

std::string_view equation_of(Coupling coupling) {
  switch (coupling) {
    case Coupling::eq5:
      return "w_cp = -C w_ic - w_l - w_md";
    case Coupling::eq6:
      return "w_cp = -w_ic - C^-1 (w_l + w_md)";
    case Coupling::lambda:
      return "w_cp = -(I + lambda E)^-1 (C w_ic + w_l + w_md)";
    case Coupling::compensated:
      return "w_cp = -(I + E_loop)^-1 (C w_ic + w_l + w_md)";
    case Coupling::servo:
      return "null-seeking loop, integrated";
  }
  return "";
}

std::string term_keys(const TermMask& terms) {
  std::string keys;
  for (std::size_t t = 0; t < TermLibrary::num_terms; ++t)
    if (terms[t]) keys += (keys.empty() ? "" : ", ") + std::string(TermLibrary::terms[t].key);
  return keys;
}

}  // namespace drift
