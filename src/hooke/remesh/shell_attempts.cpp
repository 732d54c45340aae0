#include "hooke/remesh/shell_attempts.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

#include "hooke/mesh/disjoint_sets.h"
#include "hooke/mesh/mesh.h"
#include "hooke/remesh/attempts.h"
#include "hooke/remesh/flaws.h"
#include "hooke/remesh/shells.h"

namespace hooke {
namespace {

/// What became of the shells of the input that were remeshed by themselves.
class ShellOutcomes {
 public:
  ShellOutcomes(int shell_count, const RemeshResult& whole)
      : rescue_of_whole_(whole.rescue),
        shortened_in_whole_(whole.shortened),
        rescues_(shell_count, Rescue::none),
        shortened_(shell_count, 0) {}

  /// `shells`: those that were remeshed together, with this result.
  void note(const std::vector<int>& shells, const RemeshResult& result) {
    for (int s : shells) {
      rescues_[s] = result.rescue;
      shortened_[s] = 0;
    }
    shortened_[shells.front()] = result.shortened;
  }

  void tell(RemeshResult& whole) const {
    const Rescue last = std::ranges::max(rescues_);
    whole.rescue = std::max(rescue_of_whole_, last);
    whole.rescued_shells = last > rescue_of_whole_ ? static_cast<int>(std::ranges::count(rescues_, last)) : 0;
    whole.shortened = std::accumulate(shortened_.begin(), shortened_.end(), shortened_in_whole_);
  }

 private:
  Rescue rescue_of_whole_;
  int shortened_in_whole_;
  std::vector<Rescue> rescues_;  // by shell
  std::vector<int> shortened_;   // vertices; those of shells that were remeshed together are with the first
};

/// Per shell of the input: the number of a part that it is of if something is wrong there, the same one for
/// shells whose results cross; else -1.
std::vector<int> parts_at_flaws(const AttemptMaker& maker, const Attempt& run) {
  const MeasuredSurface& input = maker.input();
  DisjointSets groups(input.shell_count());
  const std::vector<Triangle>& faces = run.result.memory_order.adjacency->faces;
  for (const auto& [f, g] : run.preservation().crossings)
    groups.join({maker.shell_of_vertex(faces[f][0], run), maker.shell_of_vertex(faces[g][0], run)});
  std::vector<int> of_group(input.shell_count(), -1), part_of_shell;
  for (int v : input_vertices_at_flaws(maker, run)) of_group[groups.root(input.shell_of_vertex(v))] = 0;
  int count = 0;
  for (int& number : of_group)
    if (number == 0) number = count++;
  for (int s = 0; s < input.shell_count(); ++s) part_of_shell.push_back(of_group[groups.root(s)]);
  return part_of_shell;
}

/// By id.
std::vector<int> parts_of_vertices(const AttemptMaker& maker, const std::vector<int>& part_of_shell) {
  const MeasuredSurface& input = maker.input();
  std::vector<int> parts(input.adjacency.vertex_count, -1);
  for (int v = 0; v < input.adjacency.vertex_count; ++v)
    if (const int shell = input.shell_of_vertex(v); shell >= 0) parts[maker.id_of(v)] = part_of_shell[shell];
  return parts;
}

std::vector<std::vector<int>> shells_of_parts(std::size_t parts, const std::vector<int>& part_of_shell) {
  std::vector<std::vector<int>> shells(parts);
  for (std::size_t s = 0; s < part_of_shell.size(); ++s)
    if (part_of_shell[s] >= 0) shells[part_of_shell[s]].push_back(static_cast<int>(s));
  return shells;
}

/// By how much the parts may multiply the numbers of faces that they should have, so that together they add
/// no more than the whole may.
double growth_of_parts(const Attempt& whole, double max_faces, const std::vector<PartOfResult>& parts) {
  double faces = 0;
  for (const PartOfResult& part : parts) faces += part.result.adaptation.target_faces;
  return 1 + (max_faces - whole.result.adaptation.target_faces) / faces;
}

/// For a part of the input that is wrong in `last`.
Attempt attempt_for(const AttemptMaker& whole, const PartOfMesh& part, PartOfResult of_first,
                    const Attempt& last, bool leaves_it, double growth, const BestOfPart& best_of_part) {
  const MemoryOrder order = find_memory_order(part.mesh);
  AttemptMaker maker = whole.for_part(part, order, last);
  const double max_faces = growth * of_first.result.adaptation.target_faces;
  Attempt first;
  first.mesh = std::move(of_first.mesh);
  first.result = std::move(of_first.result);
  return best_of_part(maker, std::move(first), max_faces, leaves_it);
}

}  // namespace

void remesh_shells(AttemptMaker& maker, const Attempt& unmended, double max_faces,
                   const BestOfPart& best_of_part, Attempt& best) {
  constexpr int max_rounds = 3;
  const MeasuredSurface& input = maker.input();
  maker.judge_by_scale_of(best);
  Attempt last = best;
  ShellOutcomes outcomes(input.shell_count(), best.result);
  std::vector<int> before;
  bool was_interrupted = false;
  for (int round = 0; round <= max_rounds && !last.keeps_promises(); ++round) {
    const std::vector<int> part_of_shell = parts_at_flaws(maker, last);
    const bool is_all_or_none =
        std::ranges::adjacent_find(part_of_shell, std::not_equal_to()) == part_of_shell.end();
    if (is_all_or_none) return;
    const bool is_last = round == max_rounds || part_of_shell == before;
    const std::vector<int> part_of_vertex = parts_of_vertices(maker, part_of_shell);
    const auto wrong = std::ssize(part_of_vertex) - std::ranges::count(part_of_vertex, -1);
    if (is_last && static_cast<double>(wrong) > few_vertices * input.adjacency.vertex_count) return;
    std::vector<PartOfMesh> parts = parts_of_mesh(maker.mesh(), maker.options.constraints, part_of_vertex);
    std::vector<PartOfMesh> replaced;
    std::vector<Attempt> attempts;
    std::vector<PartOfResult> first = parts_of_result(parts, unmended.mesh, unmended.result);
    const std::vector<std::vector<int>> shells_of = shells_of_parts(parts.size(), part_of_shell);
    const double growth = growth_of_parts(best, max_faces, first);
    for (std::size_t p = 0; p < parts.size(); ++p) {
      Attempt next = attempt_for(maker, parts[p], std::move(first[p]), last, is_last, growth, best_of_part);
      was_interrupted = next.is_interrupted();
      if (was_interrupted) break;
      if (!next.result.measures) continue;  // not finite
      outcomes.note(shells_of[p], next.result);
      replaced.push_back(std::move(parts[p]));
      attempts.push_back(std::move(next));
    }
    if (was_interrupted) best.result.reason = last.result.reason = StopReason::interrupted;
    if (attempts.empty()) return;
    std::vector<RemeshedMesh> results;
    for (const Attempt& a : attempts) results.push_back({a.mesh, a.result});
    replace_parts(replaced, results, last.mesh, last.result);
    last.run.reset();  // which made another mesh
    outcomes.tell(last.result);
    maker.judge(last);
    if (last.is_better_than(best)) best = last;
    if (is_last || was_interrupted) return;
    before = part_of_shell;
  }
}

}  // namespace hooke
