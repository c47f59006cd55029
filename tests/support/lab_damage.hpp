#pragma once

#include "tests/support/lab_variants.hpp"

namespace drift::test {

/// Variants that are refused with one message, which says this.
inline std::vector<Variant> refused_variants() {
  using Units = LabFile::Units;
  return {
      {"DateBetween", {}, replace("Zeit_ms", "Zeit"), "lab.csv", 0, "no column 'Zeit_ms'"},
      {"SlipInAName", canonical, replace("acc_x", "acc_X"), "lab.csv", 0, "Did you mean 'acc_x'?"},
      {"UnderscoreForgotten", canonical, replace("acc_y", "accy"), "lab.csv", 0,
       "Did you mean 'acc_y'?"},
      {"LetterDoubled", canonical, replace("gimbal_outer", "gimbal_outter"), "lab.csv", 0,
       "Did you mean 'gimbal_outer'?"},
      {"UnknownPosition",
       {},
       replace("Lage 2", "Lage zwei"),
       "lab.csv",
       0,
       "found 'Lage zwei' (expected the number of a position, or 'Lage 1'"},
      {"BothDecimals",
       {},
       [](std::string& t) { t[t.rfind(',')] = '.'; },
       "lab.csv",
       0,
       "decimal points here, decimal commas in line 2"},
      {"WrongDecimal",
       [](LabFile& f) { f.more = "decimal = \".\"\n"; },
       {},
       "lab.csv",
       0,
       "a decimal point"},
      {"UnitsContradict", [](LabFile& f) { f.units = Units::study; }, replace(";Ax;", ";Ax [g];"),
       "lab.csv", 0, "the file says [g]"},
      {"NoUnit",
       [](LabFile& f) { f.units = Units::none; },
       {},
       "lab.csv",
       0,
       "the unit is missing"},
      {"MetresCalledG",
       [](LabFile& f) { units("g", 1.0 / 9.80665, 8)(f); },
       {},
       "lab.csv",
       0,
       "the numbers look like [m/s^2]"},
      {"GCalledMilligrams", units("mg", 1.0, 8), {}, "lab.csv", 0, "the numbers look like [g]"},
      {"UnknownUnit",
       [](LabFile& f) {
         f.units = Units::header;
         f["acc_x"].unit = "LSB";
       },
       {},
       "lab.csv",
       0,
       "unknown unit 'LSB'"},
      {"RowsTwice",
       {},
       [](std::string& t) { t += t.substr(t.find("\r\n") + 2); },
       "lab.csv",
       0,
       "comes after"},
      {"DecimalCommasBetweenCommas", separators(',', ','), {}, "lab.csv", 0, "cells (expected"},
      {"RowCutInside",
       {},
       [](std::string& t) {
         const auto at = t.find("Lage 2");
         t.erase(at, t.find("\r\n", at) - at);
       },
       "lab.csv",
       0,
       "cells (expected 10"},
      {"TextInASensor",
       {},
       [](std::string& t) {
         std::size_t at = t.find("Lage 1;") + 7;
         t.replace(at, 4, "Ovrl");
       },
       "lab.csv",
       0,
       "found 'Ovrl"},
      {"NoHeader",
       {},
       [](std::string& t) { t.erase(0, t.find("\r\n") + 2); },
       "lab.csv",
       0,
       "header"},
      {"OtherExtension", {}, {}, "lab.tdms", 0, "no format is known"},
  };
}

}  // namespace drift::test
