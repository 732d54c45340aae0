// How much memory a run on a mesh file will take, before it is read.
#pragma once

#include <cstddef>
#include <filesystem>

#include "hooke/report/report.h"
#include "options.h"

namespace hooke::app {

/// Bytes that a run may take: --memory-limit, else memory_limit().
std::size_t memory_allowed(const Settings& settings);

/// Throws LimitError, with the figures, if the size and format of the input file tell that the run would take
/// more than --memory-limit. Throws InputError for a format that is unknown.
void require_memory_for_file(const Settings& settings);

/// The same by the number of vertices; with `adapt` also by those of the result, once the record has the area
/// of the mesh and its target length, and if these are more, also without --memory-limit.
void require_memory(const Settings& settings, std::size_t vertices, const RunRecord& record);

/// The number of faces of a result that fit into --memory-limit.
double most_faces(const Settings& settings);

/// An upper estimate of the peak in bytes, by the size of the file, its format, and the finer mesh that
/// `adapt` makes of it where the length is given in natural lengths; --min-length is not foreseen.
std::size_t memory_for(const std::filesystem::path& mesh, const Settings& settings);

}  // namespace hooke::app
