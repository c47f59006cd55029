#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "tests/support/lab_file.hpp"

namespace drift::test {

/// A file in UTF-16 with its mark.
inline std::string utf16(const std::string& ascii, bool big) {
  std::string out = big ? "\xFE\xFF" : "\xFF\xFE";
  for (const char c : ascii) {
    if (big) out += '\0';
    out += c;
    if (!big) out += '\0';
  }
  return out;
}

inline void every_line(std::string& text, const std::function<void(std::string&)>& change) {
  std::string out;
  for (std::size_t begin = 0; begin < text.size();) {
    const auto end = std::min(text.find("\r\n", begin), text.size());
    std::string line = text.substr(begin, end - begin);
    change(line);
    out += line + "\r\n";
    begin = end + 2;
  }
  text = out;
}

/// One way to write, or to damage, the file of a laboratory.
struct Variant {
  std::string name;
  std::function<void(LabFile&)> style = [](LabFile&) {};
  std::function<void(std::string&)> bytes = [](std::string&) {};
  std::string file = "lab.csv";
  std::size_t rows_lost = 0;  ///< at the end
  std::string refused = {};   ///< what the one message says; empty: it is read
};

inline void PrintTo(const Variant& v, std::ostream* out) {
  *out << v.name;
}

/// Changes of style and of text that variants are made of.
using Style = std::function<void(LabFile&)>;
using Bytes = std::function<void(std::string&)>;

inline Bytes replace(const std::string& from, const std::string& to) {
  return [=](std::string& text) {
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  };
}

/// Another unit for the channels that begin so.
inline Style unit_of(const std::string& start, const std::string& unit, double size, int decimals) {
  return [=](LabFile& f) {
    for (LabColumn& c : f.columns)
      if (c.channel.starts_with(start)) {
        c.unit = unit;
        c.size = size;
        c.decimals = decimals;
      }
  };
}
inline Style units(const std::string& unit, double size, int decimals) {
  return unit_of("acc_", unit, size, decimals);
}
inline Style angles(const std::string& unit, double size, int decimals) {
  return unit_of("gimbal_", unit, size, decimals);
}

inline Style separators(char delimiter, char decimal) {
  return [=](LabFile& f) {
    f.delimiter = delimiter;
    f.decimal = decimal;
  };
}

/// The program's own names, units in the header.
inline void canonical(LabFile& f) {
  f.mapped = false;
  f.units = LabFile::Units::header;
  f.date = false;
  f.position_names = false;
  for (LabColumn& c : f.columns) {
    c.sign = 1.0;
    c.offset = 0.0;
  }
}

/// Of the last line only so many characters, without line end.
inline Bytes last_line(std::size_t keep) {
  return [=](std::string& text) {
    const auto begin = text.rfind("\r\n", text.size() - 3) + 2;
    text = text.substr(0, begin + keep);
  };
}

/// Variants that are read to the same numbers.
inline std::vector<Variant> read_variants() {
  constexpr double deg = detail::deg;
  using Units = LabFile::Units;
  return {
      {"AsItIs"},
      {"CommaPoint", separators(',', '.')},
      {"SemicolonPoint", separators(';', '.')},
      {"TabComma", separators('\t', ',')},
      {"TabPoint", separators('\t', '.'), {}, "lab.tsv"},
      {"Text", separators('\t', '.'), {}, "LAB.TXT"},
      {"Blanks",
       [](LabFile& f) {
         f.delimiter = ' ';
         f.decimal = '.';
         f.date = f.position_names = false;
       },
       {},
       "lab.dat"},
      {"SaidDelimiter", [](LabFile& f) { f.more = "delimiter = \";\"\ndecimal = \",\"\n"; }},
      {"UnixLineEnds", [](LabFile& f) { f.line_end = "\n"; }},
      {"ByteOrderMark", {}, [](std::string& t) { t.insert(0, "\xEF\xBB\xBF"); }},
      {"Utf16Little", {}, [](std::string& t) { t = utf16(t, false); }},
      {"Utf16Big", {}, [](std::string& t) { t = utf16(t, true); }},
      {"Latin1", {}, replace("Kran faehrt", "Kran f\xE4hrt")},
      {"Latin1Header", [](LabFile& f) { f["acc_x"].header = "Beschl\u00E4ge"; },
       replace("Beschl\u00E4ge", "Beschl\xE4ge")},
      {"QuotedCells",
       {},
       [](std::string& t) {
         every_line(t, [](std::string& line) {
           std::string out = "\"";
           for (const char c : line) out += c == ';' ? std::string("\";\"") : std::string(1, c);
           line = out + "\"";
         });
       }},
      {"QuotedDecimalCommas", separators(';', ','),
       [](std::string& t) {
         every_line(t, [](std::string& line) {
           std::string out = "\"";
           for (const char c : line) out += c == ';' ? std::string("\",\"") : std::string(1, c);
           line = out + "\"";
         });
       }},
      {"BlankLines",
       {},
       [](std::string& t) { every_line(t, [](std::string& line) { line += "\r\n"; }); }},
      {"Preamble",
       [](LabFile& f) {
         f.preamble = {
             "LabVIEW Measurement", "Writer_Version\t2", "Operator;Meier", "Rate;0,05", "",
             "***End_of_Header***"};
       }},
      {"PreambleSkipped",
       [](LabFile& f) {
         f.preamble = {"Gains;1;2;3;4;5;6;7;8;9", "Zeit_ms;Lage;Ax"};
         f.more = "skip_rows = 2\n";
       }},
      {"Comments",
       [](LabFile& f) {
         f.preamble = {"# table = A", "# operator: Meier"};
       }},
      {"UnitsInHeader", [](LabFile& f) { f.units = Units::header; }},
      {"UnitsInRoundBrackets", [](LabFile& f) { f.units = Units::round_brackets; }},
      {"UnitsInARow", [](LabFile& f) { f.units = Units::row; }},
      {"UnitsInARowBelowAPreamble",
       [](LabFile& f) {
         f.units = Units::row;
         f.preamble = {"Messung 12", "Pruefer Meier"};
       }},
      {"OwnOrder", [](LabFile& f) { std::ranges::reverse(f.columns); }},
      {"NoDate", [](LabFile& f) { f.date = false; }},
      {"DateIgnored", [](LabFile& f) { f.more = "ignore = [\"Datum\", \"Bemerkung\"]\n"; }},
      {"PositionNumbers", [](LabFile& f) { f.position_names = false; }},
      {"Seconds",
       [](LabFile& f) {
         f["time"].unit = "s";
         f["time"].size = 1.0;
       }},
      {"Microseconds",
       [](LabFile& f) {
         f["time"].unit = "us";
         f["time"].size = 1e-6;
       }},
      {"Minutes",
       [](LabFile& f) {
         f["time"].unit = "min";
         f["time"].size = 60.0;
         f["time"].decimals = 9;
       }},
      {"G", units("g", 1.0, 9)},
      {"Milligrams", units("mg", 1e-3, 6)},
      {"Micro", units("ug", 1e-6, 3)},
      {"MicroSign", units("\u00B5g", 1e-6, 3)},
      {"MetresWithoutCaret", units("m/s2", 1.0 / 9.81, 8)},
      {"MetresSquareSign", units("m/s\u00B2", 1.0 / 9.81, 8)},
      {"Counts", units("2.5 ug", 2.5e-6, 0)},
      {"Degrees", angles("deg", deg, 6)},
      {"DegreeSign", angles("\u00B0", deg, 6)},
      {"Arcseconds", angles("arcsec", deg / 3600.0, 2)},
      {"ResolverCounts", angles("0.1 arcsec", deg / 36000.0, 0)},
      {"AllSignsTurned",
       [](LabFile& f) {
         for (LabColumn& c : f.columns)
           if (c.channel != "time" && c.channel != "position") c.sign = -c.sign;
       }},
      {"AllOffsets",
       [](LabFile& f) {
         for (LabColumn& c : f.columns)
           if (c.channel.starts_with("gimbal_")) c.offset = -0.25;
       }},
      {"Canonical", canonical},
      {"CanonicalWithUnitsOfItsOwn",
       [=](LabFile& f) {
         canonical(f);
         f.units = Units::study;
       }},
      {"OneMoreSensor",
       {},
       [](std::string& t) {
         every_line(
             t, [i = 0](std::string& line) mutable { line += i++ == 0 ? ";Oel [bar]" : ";1,5"; });
       }},
      {"NotANumberInAnExtraColumn",
       {},
       [](std::string& t) {
         every_line(t, [i = 0](std::string& line) mutable {
           line += i == 0 ? ";Oeltemperatur [degC]" : i == 3 ? ";n/a" : ";1,5";
           ++i;
         });
       }},
      {"EmptyLastColumn",
       {},
       [](std::string& t) { every_line(t, [](std::string& line) { line += ";"; }); }},
      {"CutInTheMiddle", {}, last_line(40), "lab.csv", 1},
      {"CutAfterACell", {}, last_line(20), "lab.csv", 1},
      {"CutInTheLastNumber", [](LabFile& f) { f.date = false; },
       [](std::string& t) { t.resize(t.size() - 5); }, "lab.csv", 1},
      {"NoLineEndAtTheEnd",
       [](LabFile& f) {
         f.date = false;
         f.last_line_end = false;
       }},
  };
}

}  // namespace drift::test
