#include "hooke/io/vertex_lists.h"

#include "errors.h"
#include "hooke/core/error.h"
#include "temporary_folder.h"

namespace hooke {
namespace {

TEST(IdList, ReadsOneIdALine) {
  const test::TemporaryFolder folder;
  test::write_text(folder / "ids", "# corners\n0\n\n  7 # the tip\n3\n");
  EXPECT_EQ(read_id_list(folder / "ids", 8), (std::vector{0, 7, 3}));
}

TEST(IdList, NamesTheLineOfWhatIsNotAnId) {
  const test::TemporaryFolder folder;
  const auto read = [&](const char* text) {
    test::write_text(folder / "ids", text);
    return read_id_list(folder / "ids", 8);
  };
  const std::string name = (folder / "ids").string();
  EXPECT_ERROR(InputError, name + ":2: vertex id 8; expected 0 to 7", read("1\n8\n"));
  EXPECT_ERROR(InputError, name + ":1: vertex id -1; expected 0 to 7", read("-1\n"));
  EXPECT_ERROR(InputError, name + ":1: more than one value", read("1 2\n"));
  EXPECT_ERROR(InputError, name + ":3: ", read("1\n2\nx\n"));
  EXPECT_ERROR(InputError, (folder / "none").string(), read_id_list(folder / "none", 8));
}

}  // namespace
}  // namespace hooke
