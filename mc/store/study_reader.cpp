#include "mc/store/study_reader.hpp"

#include <algorithm>
#include <filesystem>

#include "core/base/check.hpp"
#include "mc/store/open_files.hpp"
#include "mc/store/origin.hpp"

namespace drift::mc {

namespace {

/// By the manifest: closing a worker file would drop what locks this process has on it. Where there
/// is none, nobody is at work.
Locks locks_of(const std::string& folder) {
  const std::string manifest = folder + "/manifest.json";
  if (std::filesystem::exists(manifest)) return probe_locks(manifest);
  const std::vector<std::string> files = worker_files(folder);
  return files.empty() ? Locks::kernel : probe_locks(files.front());
}

}  // namespace

StudyReader::StudyReader(const std::string& folder)
    : StudyReader(folder, std::make_shared<Manifest>(read_manifest(folder))) {}

StudyReader::StudyReader(const std::string& folder, std::shared_ptr<const Manifest> manifest)
    : folder_(folder),
      manifest_(std::move(manifest)),
      asked_(manifest_->runs),
      locks_(locks_of(folder)) {
  allow_many_files();
  refresh();
}

void StudyReader::note(std::string text) {
  if (std::find(notes_.begin(), notes_.end(), text) == notes_.end())
    notes_.push_back(std::move(text));
}

void StudyReader::forget_files_that_are_gone() {
  for (auto source = sources_.begin(); source != sources_.end();) {
    const std::string& path = source->first;
    if (!source->second.file || identity_of(path) == source->second.identity) {
      ++source;
      continue;
    }
    for (auto& [place, copies] : index_)
      std::erase_if(copies, [&](const auto& copy) { return copy.first == path; });
    std::erase_if(index_, [](const auto& of_place) { return of_place.second.empty(); });
    source = sources_.erase(source);
  }
}

void StudyReader::refresh() {
  forget_files_that_are_gone();
  paths_ = worker_files(folder_);
  for (const std::string& path : paths_) {
    require_worker_file(path);
    try {
      Source& source = sources_[path];
      if (!source.file) {
        source.identity = identity_of(path);
        source.file = std::make_unique<WorkerFile>(path, manifest_, Database::Use::read, locks_);
      }
      if (!source.known) source.known = source.file->require_same_origin();
      bool damaged = false;
      for (const BlockEntry& e : source.file->entries(source.last_id, &damaged)) {
        source.last_id = std::max(source.last_id, e.id);
        auto& copies = index_[{e.key.point, e.key.first}];
        copies.emplace_back(path, e);
        std::stable_sort(copies.begin(), copies.end(), [](const auto& a, const auto& b) {
          return a.second.key.count > b.second.key.count;
        });
      }
      for (const Session& session : source.file->sessions())
        if (session.sound) asked_ = std::max(asked_, session.runs);
      if (damaged)
        note(fmt::format("{}: damaged; what cannot be read of it is left out. {}", path,
                         whole_blocks_are_taken_over));
    } catch (const OtherOrigin&) {
      throw;
    } catch (const InputError& error) {
      if (error.code() != ExitCode::store) throw;
      note(fmt::format("{}: damaged, cannot be read. {}", path, whole_blocks_are_taken_over));
    }
  }
}

std::vector<Session> StudyReader::sessions() {
  std::vector<Session> all;
  for (auto& [path, source] : sources_)
    if (source.file)
      for (Session& s : source.file->sessions()) {
        s.facts.emplace_back("file", path);
        all.push_back(std::move(s));
      }
  std::stable_sort(all.begin(), all.end(), [](const Session& a, const Session& b) {
    return a.started_utc < b.started_utc;
  });
  return all;
}

std::vector<BlockKey> StudyReader::keys() const {
  std::vector<BlockKey> list;
  list.reserve(index_.size());
  for (const auto& [place, copies] : index_) list.push_back(copies.front().second.key);
  return list;
}

const BlockEntry* StudyReader::listed(std::size_t point, std::uint64_t first) const {
  const auto found = index_.find({point, first});
  return found == index_.end() ? nullptr : &found->second.front().second;
}

void StudyReader::each_copy(
    std::size_t point, std::uint64_t first,
    const std::function<void(const std::string&, const std::optional<StoredBlock>&)>& visit) {
  const auto found = index_.find({point, first});
  if (found == index_.end()) return;
  for (const auto& [path, entry] : found->second) {
    const auto block = sources_.at(path).file->read(entry);
    if (!block)
      note(fmt::format("{}: the block of point {}, runs {} to {} is damaged", path, point, first,
                       first + entry.key.count - 1));
    visit(path, block);
  }
}

std::optional<StoredBlock> StudyReader::read(std::size_t point, std::uint64_t first) {
  std::optional<StoredBlock> best;
  std::string from;
  each_copy(point, first, [&](const std::string& path, const std::optional<StoredBlock>& block) {
    if (!block) return;
    if (best && !agree(best->block, block->block))
      throw InputError(
          ExitCode::self_check,
          fmt::format(
              "{}: the block of point {}, first run {} differs from that in {} (expected equal "
              "bits from every worker). Find the faulty machine with `driftscope verify`, remove "
              "its worker file and run the same command again",
              path, point, first, from));
    if (!best) best = block, from = path;
  });
  if (!best && listed(point, first) != nullptr) ++unreadable_;
  return best;
}

std::vector<StoredBlock> StudyReader::kept(const WantedPlace& wanted) {
  const std::uint64_t size = manifest_->identity.block_size;
  const auto is_wanted = [&](const BlockKey& part) {
    const std::uint64_t first = part.first - part.first % size;
    const BlockEntry* stored = listed(part.point, first);
    if (stored != nullptr && first + stored->key.count >= part.first + part.count) return false;
    return !wanted || wanted(part.point, first);
  };
  std::vector<StoredBlock> all;
  for (const std::string& path : paths_) {
    const auto& file = sources_.at(path).file;
    if (!file) continue;
    std::size_t damaged = 0;
    for (StoredBlock& part : file->kept(is_wanted, damaged)) all.push_back(std::move(part));
    if (damaged > 0)
      note(fmt::format(
          "{}: of what was kept of unfinished blocks {} damaged; those runs are "
          "executed again",
          path, damaged == 1 ? std::string("1 part is") : fmt::format("{} parts are", damaged)));
  }
  const auto key = [](const StoredBlock& part) { return key_of(part.block); };
  std::ranges::stable_sort(all, {}, key);
  std::vector<StoredBlock> once;
  for (auto at = all.begin(); at != all.end();) {
    const auto next =
        std::find_if(at, all.end(), [&](const auto& b) { return key(b) != key(*at); });
    if (std::all_of(at, next, [&](const auto& b) { return agree(at->block, b.block); }))
      once.push_back(std::move(*at));
    else
      note(
          fmt::format("{}: copies of what was kept of runs {} to {} of point {} differ (expected "
                      "equal bits from every worker); those runs are executed again. Find the "
                      "faulty machine with `driftscope verify`",
                      folder_, at->block.first, at->block.first + at->block.status.size() - 1,
                      at->block.point));
    at = next;
  }
  return once;
}

void StudyReader::each_result(const StopRules& rules, const Visitor& visit) {
  for (std::size_t p = 0; p < manifest_->points.size(); ++p) each_result(rules, p, visit);
}

bool StudyReader::each_result(const StopRules& rules, std::size_t point, const Visitor& visit) {
  const std::unique_ptr<StopRule> rule = rules ? rules(point) : nullptr;
  bool gap = false;
  std::uint64_t next = 0;
  for (auto at = index_.lower_bound({point, 0}); at != index_.end() && at->first.first == point;
       ++at) {
    const std::uint64_t first = at->first.second;
    if (asked_ > 0 && first >= asked_) return false;
    const auto block = read(point, first);
    if (!block || first != next) gap = true;  // a rule sees only what is without a gap from run 0
    next = first + manifest_->identity.block_size;
    if (!block) continue;
    visit(*block);
    if (rule && !gap && rule->enough(block->block)) return true;
  }
  return false;
}

std::vector<std::string> StudyReader::unsound() {
  std::vector<std::string> list;
  for (const std::string& path : paths_) {
    const auto source = sources_.find(path);
    if (source == sources_.end() || !source->second.file || !source->second.file->sound())
      list.push_back(path);
  }
  return list;
}

std::vector<std::string> StudyReader::misfits() {
  std::vector<std::string> lines;
  for (auto& [path, source] : sources_)
    if (source.file)
      for (std::string& line : source.file->misfits()) lines.push_back(std::move(line));
  return lines;
}

void ResultsDigest::add(const StoredBlock& b) {
  const BlockKey key = key_of(b.block);
  hash_.update(fmt::format("{} {} {}\n", key.point, key.first, key.count));
  hash_.update(encode(b.block, manifest_.points[key.point].columns.size()));
}

std::string ResultsDigest::finish() {
  return to_hex(hash_.finish());
}

std::string results_digest(StudyReader& reader, const StopRules& rules) {
  ResultsDigest digest(reader.manifest());
  reader.each_result(rules, [&](const StoredBlock& b) { digest.add(b); });
  return digest.finish();
}

std::vector<BlockKey> all_blocks(const Manifest& manifest, std::uint64_t runs) {
  const std::uint64_t size = manifest.identity.block_size;
  std::vector<BlockKey> list;
  for (std::size_t p = 0; p < manifest.points.size(); ++p)
    for (std::uint64_t first = 0; first < runs; first += size)
      list.push_back({p, first, static_cast<std::size_t>(std::min(size, runs - first))});
  return list;
}

}  // namespace drift::mc
