#include "analysis/report/page/provenance.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "analysis/report/page/json.hpp"
#include "analysis/report/page/report.hpp"
#include "core/base/build_info.hpp"
#include "core/base/sha256.hpp"
#include "mc/store/provenance.hpp"

namespace drift::report {
namespace {

std::string fact_of(const mc::Facts& facts, std::string_view key) {
  const auto found = std::ranges::find(facts, key, &mc::Facts::value_type::first);
  return found == facts.end() ? "" : found->second;
}

Json file_json(const SourceFile& file) {
  return {{"path", file.path}, {"sha256", text_or_null(file.sha256)}};
}

Json json_of(const Provenance& p) {
  Json recordings = Json::array();
  for (const SourceFile& file : p.recordings) recordings.push_back(file_json(file));
  return {{"version", p.version},
          {"commit", p.commit},
          {"compiler", p.compiler},
          {"instruction_set", p.instruction_set},
          {"date", p.date},
          {"command_line", p.command_line},
          {"study", p.study.empty() ? Json(nullptr) : file_json(p.study.front())},
          {"recordings", std::move(recordings)}};
}

}  // namespace

Provenance provenance_of(const std::string& study, const std::vector<std::string>& recordings) {
  const mc::Facts facts = mc::provenance();
  Provenance p{build_info().version,
               build_info().commit,
               fact_of(facts, "started_utc"),
               fact_of(facts, "command_line"),
               {},
               {},
               build_info().compiler,
               build_info().instruction_set};
  if (!study.empty()) p.study.push_back({study, sha256_hex_of_file(study)});
  for (const std::string& path : recordings)
    p.recordings.push_back({path, sha256_hex_of_file(path)});
  return p;
}

std::string with_provenance(const std::string& document, const Provenance& provenance) {
  Json json = Json::parse(document);
  json["provenance"] = json_of(provenance);
  return dumped(json);
}

Report with_provenance(Report report, Provenance provenance) {
  if (!report.document.second.empty())
    report.document.second = with_provenance(report.document.second, provenance);
  report.provenance = std::move(provenance);
  return report;
}

}  // namespace drift::report
