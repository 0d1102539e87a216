#include "farm/farm_folder.h"

#include <charconv>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <system_error>

#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "limpid/core/error.h"
#include "limpid/files/text/frame_range.h"
#include "limpid/version.h"

#include "files/atomic_file.h"

namespace limpid {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw Error(file.string() + ": cannot be read");
  return text;
}

void make_folder(const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) throw Error(folder.string() + ": cannot be made (" + failed.message() + ")");
}

/// "frame 7: x" is "x".
std::string without_frame(std::string sentence, int frame) {
  const std::string before = "frame " + std::to_string(frame) + ": ";
  return sentence.starts_with(before) ? sentence.substr(before.size()) : sentence;
}

}  // namespace

FileState state_of(const fs::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return "";
  char text[96];
  std::snprintf(text, sizeof text, "%llu %lld %lld.%09ld",
                static_cast<unsigned long long>(status.st_ino),
                static_cast<long long>(status.st_size),
                static_cast<long long>(status.st_mtim.tv_sec), status.st_mtim.tv_nsec);
  return text;
}

fs::path farm_folder_of(const std::string& output) {
  fs::path folder;
  for (const fs::path& part : fs::path(output)) {
    if (has_frame_number(part.string())) break;
    folder /= part;
  }
  std::string name = fs::path(output).stem().string();
  if (has_frame_number(name)) {
    // The digits in which two names differ are removed.
    const std::string one = name_of_frame(name, 1), two = name_of_frame(name, 2);
    std::size_t last = 0;
    while (one[last] == two[last]) ++last;
    std::size_t first = last;
    while (first > 0 && one[first - 1] == '0') --first;
    name = one.substr(0, first) + one.substr(last + 1);
  }
  while (!name.empty() && std::string(".-_ ").find(name.back()) != std::string::npos) {
    name.pop_back();
  }
  if (folder.filename() == fs::path(output).filename()) folder = folder.parent_path();
  return folder / ((name.empty() ? "frames" : name) + ".farm");
}

void FarmFolder::make() const {
  make_folder(path_ / "log");
  make_folder(path_ / "failed");
}

bool FarmFolder::has_record() const {
  std::error_code ignored;
  return fs::exists(file("farm.json"), ignored);
}

FarmRecord FarmFolder::record() const {
  const fs::path name = file("farm.json");
  if (!has_record()) {
    throw Error(path_.string() +
                ": not a farm (it has no farm.json); expected the folder of a farm, " +
                "as in shot/wet.farm");
  }
  try {
    const json read = json::parse(text_of(name));
    FarmRecord record;
    record.folder = read.at("folder").get<std::string>();
    record.outputs = read.at("outputs").get<std::vector<std::string>>();
    record.frames = read.at("frames").get<std::size_t>();
    record.kept = read.at("kept").get<std::size_t>();
    for (const auto& [frame, state] : read.at("before").items()) {
      record.before[std::stoi(frame)] = state.get<std::string>();
    }
    record.jobs = read.at("jobs").get<std::vector<long>>();
    if (record.outputs.empty()) throw Error(name.string() + ": expected outputs");
    return record;
  } catch (const json::exception& error) {
    throw Error(name.string() + ": " + error.what());
  } catch (const std::logic_error&) {  // from stoi
    throw Error(name.string() + ": before: expected numbers of frames");
  }
}

std::vector<Chunk> FarmFolder::chunks() const {
  const fs::path name = file("chunks.txt");
  const std::string text = text_of(name);
  try {
    return chunks_in(text);
  } catch (const Error& error) {
    throw Error(name.string() + ": " + error.what());
  }
}

void FarmFolder::write(const FarmRecord& record) const {
  json before = json::object();
  for (const auto& [frame, state] : record.before) before[std::to_string(frame)] = state;
  const json all = {{"version", kVersion},       {"folder", record.folder.string()},
                    {"outputs", record.outputs}, {"frames", record.frames},
                    {"kept", record.kept},       {"before", before},
                    {"jobs", record.jobs}};
  write("farm.json", all.dump(2, ' ', false, json::error_handler_t::replace) + "\n");
}

void FarmFolder::write(const char* name, const std::string& text) const {
  AtomicFile written(file(name));
  written.write(text);
  written.commit();
}

std::map<int, std::string> FarmFolder::failed() const {
  std::map<int, std::string> failures;
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(path_ / "failed", failed)) {
    const std::string name = entry.path().filename().string();
    int frame = 0;
    const char* const end = name.data() + name.size();
    const auto read = std::from_chars(name.data(), end, frame);
    if (read.ec != std::errc() || std::string_view(read.ptr) != ".txt") continue;
    std::string sentence = text_of(entry.path());
    sentence.erase(sentence.find_last_not_of('\n') + 1);
    // An empty one comes from a full disk: the task's log may have the sentence.
    if (!sentence.empty()) failures[frame] = without_frame(sentence, frame);
  }
  return failures;
}

void FarmFolder::forget_failures() const {
  std::error_code failed;
  fs::remove(file("summary.txt"), failed);
  fs::remove_all(path_ / "failed", failed);
  make();
}

}  // namespace limpid
