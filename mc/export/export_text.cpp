#include "mc/export/export_text.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "core/base/atomic_file.hpp"
#include "core/base/check.hpp"
#include "core/base/seal.hpp"
#include "core/base/sha256.hpp"
#include "core/base/words.hpp"
#include "core/config/quantity.hpp"
#include "mc/export/swept_coordinates.hpp"

namespace drift::mc {
namespace {

/// A text file in the making; a full disk is an InputError.
class TextOut {
 public:
  explicit TextOut(const std::string& path)
      : path_(path), target_(path), file_(std::fopen(target_.temporary().c_str(), "wb")) {
    if (file_ == nullptr) throw_cannot_write(path_, std::strerror(errno));
  }
  ~TextOut() {
    if (file_ != nullptr) std::fclose(file_);
  }
  TextOut(const TextOut&) = delete;
  TextOut& operator=(const TextOut&) = delete;

  void put(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), file_) != text.size())
      throw_cannot_write(path_, std::strerror(errno));
  }
  void commit() {
    if (std::fclose(std::exchange(file_, nullptr)) != 0)
      throw_cannot_write(path_, std::strerror(errno));
    close_seal(target_.temporary(), path_);
    target_.commit();
  }

 private:
  std::string path_;
  AtomicFile target_;
  std::FILE* file_;
};

/// Facts of an export in text, with the place of its digest near the top.
Facts sealed_provenance(StudyReader& reader) {
  Facts facts = provenance_of(reader);
  facts.insert(facts.begin() + 1, {std::string(seal_key), open_seal()});
  return facts;
}

/// A field of CSV; what a spreadsheet would take for a formula is made plain text.
std::string sheet_field(std::string text) {
  if (!text.empty() && std::string_view("=+-@").find(text.front()) != std::string_view::npos)
    text.insert(0, "'");
  return csv_field(text);
}

/// The same of a swept text; a quantity is no formula, and a table is joined by it.
std::string swept_field(const std::string& text) {
  return config::quantity_in(text) ? csv_field(text) : sheet_field(text);
}

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

}  // namespace

const char* name(RunStatus status) {
  switch (status) {
    case RunStatus::ok:
      return "ok";
    case RunStatus::integrator_failed:
      return "integrator_failed";
    case RunStatus::filter_diverged:
      return "filter_diverged";
    case RunStatus::nonfinite:
      return "nonfinite";
    case RunStatus::timeout:
      return "timeout";
    case RunStatus::error:
      return "error";
  }
  return "unknown";
}

std::string plain_name(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    out += plain ? c : '_';
  }
  if (out.empty() || (out.front() >= '0' && out.front() <= '9')) out.insert(0, "c_");
  return out;
}

std::vector<std::string> plain_names(const std::vector<std::string>& names,
                                     std::set<std::string> taken) {
  std::vector<std::string> plain;
  for (const std::string& wanted : names) {
    std::string name = plain_name(wanted);
    for (int i = 2; !taken.insert(name).second; ++i)
      name = fmt::format("{}_{}", plain_name(wanted), i);
    plain.push_back(std::move(name));
  }
  return plain;
}

Facts provenance_of(StudyReader& reader) {
  const Manifest& m = reader.manifest();
  std::uint64_t stored = 0;
  for (const BlockKey& key : reader.keys()) stored += key.count;
  Facts facts{{"study_hash", m.hash},
              {"study_sha256", sha256_hex(m.study)},
              {"seed", std::to_string(m.identity.seed)},
              {"runs_per_point", std::to_string(reader.runs())},
              {"runs_stored", std::to_string(stored)},
              {"block_size", std::to_string(m.identity.block_size)}};
  facts.insert(facts.end(), m.provenance.begin(), m.provenance.end());
  const auto sessions = reader.sessions();
  facts.emplace_back("sessions", std::to_string(sessions.size()));
  if (!sessions.empty()) facts.emplace_back("ended_utc", sessions.back().ended_utc);
  facts.emplace_back("study", m.study);
  return facts;
}

void export_csv(StudyReader& reader, const StopRules& rules, const std::string& path,
                const std::vector<StudyPoint>& study_points) {
  const auto& points = reader.manifest().points;
  std::vector<Column> all;  // the columns of all points, each once
  std::map<std::string, std::size_t> place;
  std::vector<std::vector<std::size_t>> to(points.size());
  for (std::size_t p = 0; p < points.size(); ++p)
    for (const Column& c : points[p].columns) {
      const auto [at, fresh] =
          place.emplace(fmt::format("{} [{}]", c.name, c.unit.symbol.view()), all.size());
      if (fresh) all.push_back(c);
      to[p].push_back(at->second);
    }
  TextOut out(path);
  for (const auto& [key, value] : sealed_provenance(reader)) {
    std::string text =
        key == "study" ? value : one_line(value);  // the study stays readable, line by line
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos;)
      text.replace(at, 1, "\n# " + key + ": "), at += key.size() + 5;
    out.put(fmt::format("# {}: {}\n", key, text));
  }
  for (std::size_t p = 0; p < points.size(); ++p)
    out.put(fmt::format("# point {}: {}\n", p, one_line(points[p].label)));
  const std::vector<SweptCoordinate> swept = swept_coordinates(study_points);
  std::vector<std::string> swept_at(points.size());  // the cells of each point
  std::string line = "point,run,status";
  for (const SweptCoordinate& s : swept) {
    line += "," + sheet_field(s.title());
    for (std::size_t p = 0; p < points.size(); ++p)
      swept_at[p] += "," + (s.numbers.empty() ? swept_field(one_line(s.words[p]))
                                              : fmt::format("{}", s.numbers[p]));
  }
  for (const Column& c : all)
    line += "," + sheet_field(fmt::format("{} [{}]", c.name, c.unit.symbol.view()));
  out.put(line + ",t_failed [s],cause\n");
  std::vector<std::string> cells(all.size());
  reader.each_result(rules, [&](const StoredBlock& b) {
    const auto& columns = points[b.block.point].columns;
    auto failure = b.failures.begin();  // in order of runs
    for (std::size_t r = 0; r < b.block.status.size(); ++r) {
      std::fill(cells.begin(), cells.end(), "");
      for (std::size_t c = 0; c < columns.size(); ++c) {
        const double value = in_column_unit(b.block.rows[r * columns.size() + c], columns[c]);
        cells[to[b.block.point][c]] = std::isnan(value) ? "nan" : fmt::format("{}", value);
      }
      line = fmt::format("{},{},{}", b.block.point, b.block.first + r, name(b.block.status[r])) +
             swept_at[b.block.point];
      for (const std::string& cell : cells) line += "," + cell;
      if (failure != b.failures.end() && failure->run == b.block.first + r) {
        line += fmt::format(",{},{}", failure->t, sheet_field(one_line(failure->cause)));
        ++failure;
      } else {
        line += ",nan,";
      }
      out.put(line + "\n");
    }
  });
  out.commit();
}

void export_json(StudyReader& reader, const StopRules& rules, const std::string& path,
                 const std::vector<StudyPoint>& study_points) {
  const auto& points = reader.manifest().points;
  const std::vector<SweptCoordinate> swept = swept_coordinates(study_points);
  TextOut out(path);
  nlohmann::ordered_json facts;
  for (const auto& [key, value] : sealed_provenance(reader)) facts[key] = value;
  out.put("{\"provenance\": " + facts.dump(1) + ",\n\"points\": [");
  for (std::size_t p = 0; p < points.size(); ++p) {
    const auto& columns = points[p].columns;
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Column& c : columns)
      list.push_back({{"name", c.name}, {"unit", std::string(c.unit.symbol.view())}});
    nlohmann::ordered_json swept_here = nlohmann::ordered_json::object();
    for (const SweptCoordinate& s : swept) {
      if (s.numbers.empty())
        swept_here[s.title()] = s.words[p];
      else
        swept_here[s.title()] = s.numbers[p];
    }
    out.put(fmt::format("{}\n{{\"label\": {}, \"swept\": {}, \"columns\": {},\n\"runs\": [",
                        p == 0 ? "" : ",", nlohmann::json(points[p].label).dump(),
                        swept_here.dump(), list.dump()));
    bool first = true;
    nlohmann::ordered_json failures = nlohmann::ordered_json::array();
    reader.each_result(rules, p, [&](const StoredBlock& b) {
      for (std::size_t r = 0; r < b.block.status.size(); ++r) {
        std::string line = fmt::format("{}\n[{}, \"{}\"", first ? "" : ",", b.block.first + r,
                                       name(b.block.status[r]));
        first = false;
        for (std::size_t c = 0; c < columns.size(); ++c) {
          const double value = in_column_unit(b.block.rows[r * columns.size() + c], columns[c]);
          line += std::isfinite(value) ? fmt::format(", {}", value) : std::string(", null");
        }
        out.put(line + "]");
      }
      for (const Failure& f : b.failures)
        failures.push_back(
            {{"run", f.run}, {"status", name(f.status)}, {"t_s", f.t}, {"cause", f.cause}});
    });
    // A cause may quote a user's file: what is not UTF-8 is replaced, never thrown at.
    out.put("],\n\"failures\": " +
            failures.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "}");
  }
  out.put("]}\n");
  out.commit();
}

std::string study_hash_of_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string head(4096, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  for (const std::string_view mark :
       {"# study_hash: ", "{\"provenance\": {\n \"study_hash\": \""}) {
    if (!head.starts_with(mark)) continue;
    return head.substr(mark.size(), head.find_first_of("\"\n", mark.size()) - mark.size());
  }
  return {};
}

}  // namespace drift::mc
