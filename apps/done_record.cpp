#include "done_record.h"

#include <algorithm>
#include <fstream>
#include <utility>

#include "hooke/core/error.h"
#include "hooke/io/files.h"
#include "hooke/io/sha256.h"
#include "input_files.h"

namespace hooke::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

fs::path place_of_record(const MeshTask& task) {
  fs::path place = task.output;
  place.replace_filename("." + task.output.filename().string() + ".hooke.json");
  return place;
}

/// Of the content; throws InputError.
std::string hash_of(const fs::path& file) {
  const FileBytes bytes = read_regular_file(file);
  return sha256(bytes.text());
}

/// The same if there is such a file, else null.
Json hash_if_there(const fs::path& file) {
  try {
    return hash_of(file);
  } catch (const Error&) {
    return {};
  }
}

Json hashes_of_outputs(const MeshTask& task) {
  Json hashes = Json::array();
  for (const fs::path& output : task.outputs) hashes.push_back(hash_if_there(output));
  return hashes;
}

/// Of this program, so that another build does not take its results for its own.
const Json& hash_of_program() {
  static const Json hash =
      hash_if_there(fs::exists("/proc/self/exe") ? fs::canonical("/proc/self/exe") : fs::path());
  return hash;
}

}  // namespace

std::string work_hash(const Settings& s, const MeshTask& task) {
  try {
    Json work = {{"version", HOOKE_VERSION},
                 {"program", hash_of_program()},
                 {"input", hash_of(task.input)},
                 {"extension", task.input.extension().string()},
                 {"options", task.method}};
    for (const NamedFile& file : data_files(s)) work["files"].push_back(hash_of(file.path));
    return sha256(work.dump(-1, ' ', false, Json::error_handler_t::replace));
  } catch (const Error&) {
    return "";  // the run itself says what is wrong
  }
}

std::optional<Json> row_if_done(const MeshTask& task, const std::string& hash) {
  std::ifstream file(place_of_record(task));
  const Json record = Json::parse(file, nullptr, false);
  if (hash.empty() || !record.is_object() || record.value("work", Json()) != hash) return {};
  const Json row = record.value("row", Json()), hashes = hashes_of_outputs(task);
  if (!row.is_object() || std::ranges::any_of(hashes, &Json::is_null) ||
      record.value("outputs", Json()) != hashes)
    return {};
  return row;
}

void record_done(const MeshTask& task, const std::string& hash, const Json& row) {
  if (hash.empty()) return;
  Json record = {
      {"schema", "hooke-remesh/done/1"}, {"work", hash}, {"outputs", hashes_of_outputs(task)}, {"row", row}};
  PendingFile(place_of_record(task), record.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n")
      .commit();
}

}  // namespace hooke::app
