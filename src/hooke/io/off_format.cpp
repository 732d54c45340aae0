#include "hooke/io/off_format.h"

#include <fmt/format.h>

#include <limits>
#include <optional>

#include "hooke/core/printable.h"

namespace hooke {
namespace {

// Parses the keyword OFF and its prefixes; none if the word is no such keyword.
std::optional<OffHeader> parse_keyword(const Scanner& in, std::string_view word) {
  if (word.size() < 3 || !equal_ignoring_case(word.substr(word.size() - 3), "OFF")) return std::nullopt;
  OffHeader header;
  std::string_view letters = word.substr(0, word.size() - 3);
  const auto take = [&](std::string_view prefix) {
    const bool there = equal_ignoring_case(letters.substr(0, prefix.size()), prefix);
    if (there) letters.remove_prefix(prefix.size());
    return there;
  };
  header.texture = take("ST");
  header.colours = take("C");
  // 'N' stands for normals, 'n' for the dimension: the only letter whose case matters.
  header.normals = !letters.empty() && letters[0] == 'N';
  if (header.normals) letters.remove_prefix(1);
  if (!letters.empty())
    in.fail(fmt::format(
        "keyword {}; expected OFF, COFF, NOFF, CNOFF or STOFF in three dimensions; save it as OFF",
        in_quotes(word)));
  return header;
}

int read_count(const Scanner& in, std::string_view token, std::string_view what) {
  const long long count = in.integer(token, what);
  if (count < 0 || count > std::numeric_limits<int>::max() ||
      static_cast<unsigned long long>(count) > in.remaining())
    in.fail(
        fmt::format("{} is {}, but only {} bytes follow; expected as many as there are; the file is cut or "
                    "the count is wrong",
                    what, count, in.remaining()));
  return static_cast<int>(count);
}

}  // namespace

OffHeader read_off_header(Scanner& in) {
  if (!in.next_line()) in.fail("no content; expected OFF; the file is empty");
  std::string_view word = in.token();
  const std::optional<OffHeader> keyword = parse_keyword(in, word);
  OffHeader header = keyword.value_or(OffHeader{});
  if (keyword) {
    word = in.token();
    header.binary = equal_ignoring_case(word, "BINARY");
    if (header.binary) return header;
    if (word.empty() && !in.next_line())
      in.fail("the file ends after its keyword; expected the counts; it is cut");
    if (word.empty()) word = in.token();
  }
  const std::string_view faces = in.token(), edges = in.token();
  header.vertices = read_count(in, word, "vertex count");
  header.faces = read_count(in, faces, "face count");
  if (!edges.empty()) in.integer(edges, "edge count");
  if (const std::string_view more = in.token(); !more.empty())
    in.fail(fmt::format("{} after the counts; expected vertex, face and edge count only; correct it",
                        in_quotes(more)));
  return header;
}

}  // namespace hooke
