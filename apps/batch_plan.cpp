#include "batch_plan.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <map>
#include <system_error>

#include "hooke/core/error.h"
#include "hooke/core/printable.h"
#include "hooke/io/files.h"
#include "hooke/io/mesh_format.h"
#include "run_files.h"

namespace hooke::app {
namespace {

namespace fs = std::filesystem;

/// Options of files that each mesh has its own of, and the extensions of these.
constexpr std::array<std::pair<std::string_view, const char*>, 5> further_outputs = {
    {{"report", ".json"}, {"fields", ".ply"}, {"map", ".txt"}, {"trace", ".csv"}, {"trace-steps", ".csv"}}};

/// Options that the process of a mesh does not need, or gets from its task.
constexpr std::array<std::string_view, 10> of_the_batch = {
    "INPUT", "output", "suffix", "table", "skip-existing", "jobs", "threads", "quiet", "verbose", "progress"};

/// Throws InputError for an input whose name cannot be that of an output: a folder, a pattern of the shell.
void require_mesh_name(const Settings& s, const fs::path& input) {
  if (std::error_code error; fs::is_directory(input, error))
    throw InputError(
        fmt::format("{}: is a folder; expected meshes; name those in it", printable(input.string())));
  if (!s.input_format) input_format_of(input);
}

fs::path output_in_folder(const Settings& s, const fs::path& input) {
  if (!s.format_given) require_mesh_name(s, input);
  const std::string extension =
      s.format_given ? "." + name_of(*s.format == MeshFormat::msh2 ? MeshFormat::msh : *s.format)
                     : input.extension().string();
  fs::path name = input.stem();
  name += s.batch.suffix + extension;
  return s.output / name;
}

/// The file of an option for this mesh: the file itself, or one in the folder that it names.
fs::path own_file(const Settings& s, const GivenOption& option, const char* extension, const MeshTask& task) {
  fs::path path = option.values.back();
  if (path == "-")
    throw Error(
        fmt::format("--{} - is for one mesh without --table and --skip-existing; expected a folder FOLDER/, "
                    "for a file for each mesh",
                    option.name));
  if (!names_folder(path)) {
    if (s.inputs.size() == 1) return path;
    throw Error(
        fmt::format("--{} {}: one file for {} meshes; expected a folder, for a file for each; write {}/",
                    option.name, printable(path.string()), s.inputs.size(), printable(path.string())));
  }
  fs::path name = (task.output.empty() ? task.input : task.output).filename();
  name += extension;
  return path / name;
}

MeshTask task_of(const Settings& s, const fs::path& input) {
  MeshTask task{.input = input, .output = {}, .report = {}, .outputs = {}, .method = {}, .arguments = {}};
  if (is_standard_input(input))
    throw Error("INPUT is standard input; expected files, for several meshes, --table and --skip-existing");
  if (!s.check) {
    if (is_standard_output(s.output))
      throw Error(
          "--output - is for one mesh without --table and --skip-existing; expected a file or FOLDER/");
    task.output = names_folder(s.output) ? output_in_folder(s, input) : s.output;
    if (!s.format_given) format_of(task.output);  // throws
    task.outputs.push_back(task.output);
    task.arguments.push_back("--output=" + task.output.string());
  }
  for (const GivenOption& option : s.given) {
    if (std::ranges::find(of_the_batch, option.name) != of_the_batch.end()) continue;
    const auto* const further =
        std::ranges::find(further_outputs, option.name, &decltype(further_outputs)::value_type::first);
    if (further != further_outputs.end()) {
      const fs::path file = own_file(s, option, further->second, task);
      task.outputs.push_back(file);
      if (option.name == "report") task.report = file;
      task.arguments.push_back(fmt::format("--{}={}", option.name, file.string()));
      continue;
    }
    if (option.values.empty()) task.method.push_back("--" + option.name);
    for (const std::string& value : option.values) task.method.push_back("--" + option.name + "=" + value);
  }
  task.arguments.insert(task.arguments.end(), task.method.begin(), task.method.end());
  if (task.report.empty()) task.arguments.emplace_back("--report=-");
  task.arguments.push_back((input.string().starts_with("-") ? "./" : "") + input.string());
  return task;
}

/// The same text for all names of a file, whether it is there or not.
std::string identity(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0) return fmt::format("{}:{}", status.st_dev, status.st_ino);
  std::error_code error;
  const fs::path whole = fs::weakly_canonical(fs::absolute(path), error);
  return (error ? path : whole).string();
}

}  // namespace

std::vector<MeshTask> plan_batch(const Settings& s) {
  if (s.inputs.size() > 1 && !s.check && !names_folder(s.output)) {
    const std::string output = printable(s.output.string());
    throw Error(fmt::format("--output {}: one {} for {} meshes; expected a folder; write {}/", output,
                            output == "-" ? "stream" : "file", s.inputs.size(),
                            output == "-" ? "FOLDER" : output));
  }
  if (s.batch.suffix.find('/') != std::string::npos)
    throw Error("--suffix " + in_quotes(s.batch.suffix) + "; expected text without /");
  std::vector<MeshTask> tasks;
  std::map<std::string, std::string> taken;  // what a file is, by its identity
  for (const fs::path& input : s.inputs)
    taken.emplace(identity(input), "the input " + printable(input.string()));
  for (const NamedFile& file : option_files(s))
    taken.emplace(identity(file.path), std::string("the file of ") + file.role);
  if (!s.batch.table.empty()) {
    if (s.batch.table.extension() != ".csv" && s.batch.table.extension() != ".jsonl")
      throw Error(fmt::format("--table {}; expected a name that ends with .csv or .jsonl",
                              printable(s.batch.table.string())));
    const auto [place, added] = taken.emplace(identity(s.batch.table), "the file of --table");
    if (!added)
      throw Error("--table " + printable(s.batch.table.string()) + ": is " + place->second +
                  "; choose another name");
  }
  for (const fs::path& input : s.inputs) {
    tasks.push_back(task_of(s, input));
    for (const fs::path& output : tasks.back().outputs) {
      const auto [place, added] =
          taken.emplace(identity(output), "an output of " + printable(input.string()));
      if (!added)
        throw Error(fmt::format(
            "{}: would be an output of {}, and is {}; expected a file of its own for each; rename "
            "an input, run them into two folders, or give --suffix",
            printable(output.string()), printable(input.string()), place->second));
    }
  }
  return tasks;
}

void create_folders(const std::vector<MeshTask>& tasks) {
  for (const MeshTask& task : tasks)
    for (const fs::path& output : task.outputs) {
      std::error_code error;
      if (output.has_parent_path() && !fs::is_directory(output.parent_path(), error))
        fs::create_directories(output.parent_path(), error);
      if (error)
        throw OutputError(fmt::format("{}: cannot be created: {}; expected a folder, or a place for one",
                                      printable(output.parent_path().string()), error.message()));
    }
}

}  // namespace hooke::app
