#include "core/base/output_file.hpp"

#include <filesystem>

#include "core/base/atomic_file.hpp"
#include "core/base/check.hpp"
#include "core/base/temporary_file.hpp"

namespace drift {

void require_output_file(const std::string& path, const std::vector<std::string>& inputs,
                         const Stranger& stranger) {
  namespace fs = std::filesystem;
  std::error_code none;
  for (const std::string& input : inputs)
    if (fs::equivalent(path, input, none))
      throw InputError(ExitCode::usage,
                       fmt::format("{}: is an input of this command (expected another file to "
                                   "write: inputs are never written to). Choose another name",
                                   path));
  const AtomicFile trial(path);  // fails as the file itself would, and leaves nothing
  remove_stale_temporaries(fs::path(path).parent_path().string());
  if (!fs::exists(path, none) || fs::file_size(path, none) == 0) return;
  if (const std::string what = stranger(path); !what.empty())
    throw InputError(
        ExitCode::store,
        fmt::format(
            "{}: is there already, and is {} (expected a free name, or an earlier output of "
            "this command). Choose another name, or remove the file",
            path, what));
}

}  // namespace drift
