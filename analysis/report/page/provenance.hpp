#pragma once

#include <string>
#include <utility>
#include <vector>

namespace drift::report {

struct Report;

/// A file that went into a result.
struct SourceFile {
  std::string path, sha256;
};

/// By what, from what and when a result was made.
struct Provenance {
  std::string version, commit, date, command_line;  ///< date: UTC
  std::vector<SourceFile> study, recordings;        ///< a study, where there is a file of it
  std::string compiler = {}, instruction_set = {};
};

/// Of this process, made from these files as they are.
Provenance provenance_of(const std::string& study, const std::vector<std::string>& recordings);

/// The report with it on its page, and in its document under "provenance".
Report with_provenance(Report report, Provenance provenance);

/// A JSON document with it.
std::string with_provenance(const std::string& document, const Provenance& provenance);

}  // namespace drift::report
