#include "core/base/results/new_results.hpp"

namespace drift {

void begin_results(const ResultsFolder& folder) {
  BegunFolder(folder).stay();
}

std::vector<std::string> write_files(const ResultsFolder& folder,
                                     const std::vector<TextFile>& files) {
  NewResults results(folder);
  for (const auto& [name, text] : files) results.add(name, text);
  return results.commit();
}

void write_result(const ResultsFolder& folder, const std::string& name,
                  const std::function<void(const std::string& temporary)>& write) {
  NewResults results(folder);
  results.add(name, write);
  results.commit();
}

void remove_result(const ResultsFolder& folder, const std::string& name) {
  NewResults results(folder);
  results.remove(name);
  results.commit();
}

void write_text_atomically(const std::string& path, std::string_view text) {
  AtomicFile target(path);
  target.write(text);
  target.commit();
}

}  // namespace drift
