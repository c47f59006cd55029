#include "analysis/cli/study/run_words.hpp"

#include "analysis/cli/print.hpp"
#include "mc/store/study_reader.hpp"

namespace drift::cli {

std::string blocks_text(std::size_t n) {
  return n == 1 ? "1 block of runs" : fmt::format("{} blocks of runs", n);
}

std::string part_text(const mc::WorkerShare& share) {
  return share.count > 1 ? fmt::format(" of this worker's part {}/{}", share.index, share.count)
                         : "";
}

std::string empty_part_text(const mc::WorkerShare& share, const mc::Manifest& manifest,
                            std::uint64_t runs) {
  const std::size_t blocks = mc::all_blocks(manifest, runs).size();
  if (share.index < blocks) return "";
  const std::string sizes =
      fmt::format("{} of {} runs", blocks == 1 ? "1 block" : fmt::format("{} blocks", blocks),
                  manifest.identity.block_size);
  return fmt::format("this part is empty: the study has {}, so at most {} can help", sizes,
                     blocks == 1 ? "1 worker" : fmt::format("{} workers", blocks));
}

void say_empty_part(const std::string& folder, const mc::WorkerShare& share,
                    const mc::Manifest& manifest, std::uint64_t runs) {
  const std::string text = empty_part_text(share, manifest, runs);
  if (!text.empty()) say("{}: note: --worker {}/{}: {}\n", folder, share.index, share.count, text);
}

void say_asked_before(const std::string& folder, std::uint64_t before, std::uint64_t now) {
  if (before <= now) return;
  say("{}: note: {} runs per point were asked for before, {} now: what is stored stays, and the "
      "results are those of all of it. Choose another folder for a shorter study\n",
      folder, before, now);
}

std::uint64_t runs_to_go_on_to(const std::string& folder, std::uint64_t of_study, bool tells) {
  const std::uint64_t before = mc::read_manifest(folder).runs;
  if (before <= of_study) return of_study;
  if (tells)
    say("{}: note: {} runs per point were asked for before, {} in the study file; it goes on with "
        "the {}. With --runs {} it executes no more than those, and what is stored beyond stays in "
        "the results\n",
        folder, before, of_study, before, of_study);
  return before;
}

}  // namespace drift::cli
