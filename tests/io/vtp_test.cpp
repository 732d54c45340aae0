#include "hooke/io/vtp.h"

#include <gtest/gtest.h>

#include "hooke/core/error.h"
#include "hooke/io/vtk_arrays.h"
#include "support/errors.h"

namespace hooke::vtp_test {

using test::has;

// A triangle and a quadrilateral; texts of the arrays can be replaced.
struct Sample {
  std::string file = "type=\"PolyData\" byte_order=\"LittleEndian\"";
  std::string piece = "NumberOfPoints=\"5\" NumberOfPolys=\"2\"";
  std::string points = "0 0 0  1 0 0  1 1 0  0 1 0  2 1 0";
  std::string corners = "1 4 2 0 1 2 3", ends = "3 7";
  std::string more = "";

  std::string text() const {
    return "<?xml version=\"1.0\"?>\n<VTKFile " + file + ">\n<PolyData>\n<Piece " + piece +
           ">\n<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n" + points +
           "\n</DataArray></Points>\n<Polys>\n<DataArray type=\"Int64\" Name=\"connectivity\" "
           "format=\"ascii\">" +
           corners + "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">" + ends +
           "</DataArray>\n</Polys>\n" + more + "</Piece>\n</PolyData>\n</VTKFile>\n";
  }
};

TEST(Vtp, TextIsReadWithItsPolygons) {
  const MeshFile file = read_vtp(Sample{}.text(), "m");
  EXPECT_EQ(file.format, MeshFormat::vtp);
  EXPECT_EQ(file.points.cols(), 5);
  EXPECT_EQ(file.points.col(4), Vec3(2, 1, 0));
  EXPECT_EQ(file.polygons.first, (std::vector<int>{0, 3, 7}));
  EXPECT_EQ(file.polygons.items, (std::vector<int>{1, 4, 2, 0, 1, 2, 3}));
  EXPECT_TRUE(file.content.anew.empty());
}

TEST(Vtp, OtherContentIsNamedOnce) {
  Sample sample;
  sample.piece += " NumberOfLines=\"3\"";
  sample.more =
      "<PointData><Array type=\"String\" Name=\"names\" format=\"ascii\">1 2 3 4 5</Array></PointData>"
      "<CellData><DataArray type=\"Float32\" Name=\"heat\" format=\"ascii\">1 2 3 4 5</DataArray></CellData>"
      "<Lines><DataArray Name=\"connectivity\">0 1</DataArray></Lines>";
  const MeshFile file = read_vtp(sample.text(), "m");
  ASSERT_EQ(file.content.anew.size(), 1u);
  EXPECT_EQ(file.content.anew[0].message,
            "m: not kept in the output: 3 lines, point data 'names', cell data 'heat'");
  EXPECT_EQ(file.polygons.items.size(), 7u);
}

TEST(Vtp, PointDataAreValuesOfTheVertices) {
  Sample sample;
  sample.more =
      "<PointData><DataArray type=\"Float32\" Name=\"wall thickness\" format=\"ascii\">1 2 3 4 .5</DataArray>"
      "<DataArray type=\"Float64\" Name=\"Normals\" NumberOfComponents=\"3\" format=\"ascii\">"
      "0 0 1 0 0 1 0 0 1 0 0 1 0 1 0</DataArray>"
      "<DataArray type=\"UInt8\" Name=\"pair\" NumberOfComponents=\"2\" format=\"ascii\">"
      "0 1 2 3 4 5 6 7 8 9</DataArray></PointData>";
  const MeshFile file = read_vtp(sample.text(), "m");
  EXPECT_TRUE(file.content.anew.empty());
  EXPECT_EQ(find_channel(file.vertex_data, "wall_thickness")->values, (std::vector{1., 2., 3., 4., .5}));
  EXPECT_EQ(find_channel(file.vertex_data, "wall_thickness")->type, NumberType::float32);
  EXPECT_EQ(find_channel(file.vertex_data, "ny")->values, (std::vector{0., 0., 0., 0., 1.}));
  EXPECT_EQ(find_channel(file.vertex_data, "pair_1")->values, (std::vector{1., 3., 5., 7., 9.}));
  sample.more =
      "<PointData><DataArray type=\"Float32\" Name=\"heat\" format=\"ascii\">1 2</DataArray></PointData>";
  EXPECT_ERROR(InputError, "m:12: 2 numbers; expected 1 of each of 5 points", read_vtp(sample.text(), "m"));
}

std::string cell_data(const std::string& attributes, const std::string& numbers) {
  return "<CellData><DataArray Name=\"part id\" format=\"ascii\" " + attributes + ">" + numbers +
         "</DataArray></CellData>";
}

TEST(Vtp, IntegersOfCellsAreLabelsOfTheFaces) {
  Sample sample;
  for (const auto& [type, kept] : {std::pair{"UInt8", NumberType::uint8},
                                   {"Int64", NumberType::int32},
                                   {"UInt32", NumberType::uint32}}) {
    sample.more = cell_data("type=\"" + std::string(type) + "\"", "7 7");
    const MeshFile file = read_vtp(sample.text(), "m");
    EXPECT_TRUE(file.content.anew.empty());
    const FaceChannel* labels = find_channel(file.face_data, "part_id");
    ASSERT_TRUE(labels);
    EXPECT_EQ(labels->values, (std::vector<int>{7, 7}));
    EXPECT_EQ(labels->type, kept);
    EXPECT_EQ(labels->kind, LabelKind::material);
  }
}

TEST(Vtp, CellsBeforeThePolygonsHaveData) {
  Sample sample;
  sample.piece += " NumberOfVerts=\"1\" NumberOfLines=\"2\" NumberOfStrips=\"1\"";
  sample.more = cell_data("type=\"Int32\"", "1 2 3 4 -5 6");
  const MeshFile file = read_vtp(sample.text(), "m");
  EXPECT_EQ(find_channel(file.face_data, "part_id")->values, (std::vector<int>{4, -5}));
  EXPECT_EQ(find_channel(file.face_data, "part_id")->kind, LabelKind::other)
      << "numbers that differ in all are ids";
}

TEST(Vtp, CellDataThatAreNoLabelsAreNamed) {
  Sample sample;
  for (const std::string& data :
       {cell_data("type=\"Float64\"", "1 2"), cell_data("type=\"Int32\" NumberOfComponents=\"2\"", "1 2 3 4"),
        cell_data("type=\"Int64\"", "1 3000000000"),
        cell_data("type=\"UInt64\"", "1 18446744073709551615")}) {
    sample.more = data;
    const MeshFile file = read_vtp(sample.text(), "m");
    EXPECT_TRUE(file.face_data.empty());
    ASSERT_EQ(file.content.anew.size(), 1u);
    EXPECT_TRUE(has(file.content.anew[0].message, "not kept in the output: cell data 'part id'"));
  }
  sample.more = cell_data("type=\"Int32\"", "1");
  EXPECT_ERROR(InputError, "m:12: 1 numbers; expected one of each of 2 cells", read_vtp(sample.text(), "m"));
  sample.piece += " NumberOfLines=\"9223372036854775807\" NumberOfVerts=\"9223372036854775807\"";
  EXPECT_ERROR(InputError, "m:12: 1 numbers; expected one of each of", read_vtp(sample.text(), "m"));
}

TEST(Vtp, PiecesArePutTogether) {
  Sample sample;
  sample.more = cell_data("type=\"Int32\"", "1 2");
  std::string text = sample.text();
  const size_t begin = text.find("<Piece"), end = text.find("</PolyData>");
  text.insert(end, text.substr(begin, end - begin));
  const MeshFile file = read_vtp(text, "m");
  EXPECT_EQ(file.points.cols(), 10);
  EXPECT_EQ(file.polygons[3][0], 5);
  EXPECT_EQ(find_channel(file.face_data, "part_id")->values, (std::vector<int>{1, 2, 1, 2}));
}

TEST(Vtp, ErrorsNameTheLine) {
  const auto error = [](const auto& change) {
    Sample sample;
    change(sample);
    std::string message = test::message_of<InputError>([&] { read_vtp(sample.text(), "m"); });
    EXPECT_EQ(message.find('\n'), std::string::npos);
    return message;
  };
  EXPECT_TRUE(has(error([](Sample& s) { s.points = "0 0 0\n1 x 0"; }), "m:7: number is 'x'"));
  EXPECT_TRUE(has(error([](Sample& s) { s.points = "0 0 0\n1 nan 0"; }), "m:7: number is 'nan'"));
  EXPECT_TRUE(
      has(error([](Sample& s) { s.points += " 1"; }), "m:5: 16 coordinates; expected 3 of each of 5 points"));
  EXPECT_TRUE(has(error([](Sample& s) { s.corners = "1 4 5 0 1 2 3"; }),
                  "m:9: polygon 0 has point 5; expected 0 to 4"));
  EXPECT_TRUE(has(error([](Sample& s) { s.ends = "2 7"; }), "polygon 0 has corners 0 to 2"));
  EXPECT_TRUE(has(error([](Sample& s) { s.ends = "3 8"; }), "polygon 1 has corners 3 to 8 of 7"));
  EXPECT_TRUE(has(error([](Sample& s) { s.ends = "3"; }), "1 offsets; expected one of each of 2 polygons"));
  EXPECT_TRUE(has(error([](Sample& s) { s.file = "type=\"UnstructuredGrid\""; }),
                  "m:2: a file of type 'UnstructuredGrid'"));
  EXPECT_TRUE(has(error([](Sample& s) { s.file += " compressor=\"vtkLZ4DataCompressor\""; }),
                  "expected vtkZLibDataCompressor"));
  EXPECT_TRUE(has(error([](Sample& s) { s.more = "</Polys>"; }), "m:12: mismatched tag"));
  EXPECT_TRUE(has(error([](Sample& s) { s.piece = "NumberOfPoints=\"-5\""; }), "NumberOfPoints is '-5'"));
  const std::string bomb = "<?xml version=\"1.0\"?>\n<!DOCTYPE x [<!ENTITY a \"aaaa\">]>\n<VTKFile/>";
  EXPECT_ERROR(InputError, "m:2: a document type", read_vtp(bomb, "m"));
  const std::string text = Sample{}.text();
  for (size_t size = 1; size + 2 < text.size(); ++size)
    EXPECT_THROW(read_vtp(std::string_view(text).substr(0, size), "m"), InputError) << size;
}

TEST(VtkArrays, Base64IsThatOfTheStandardsExamples) {
  for (const auto& [text, bytes] : {std::pair{"", ""},
                                    {"Zg==", "f"},
                                    {"Zm8=", "fo"},
                                    {"Zm9v", "foo"},
                                    {"Zm9vYg==", "foob"},
                                    {" Zm9v\nYmE= ", "fooba"},
                                    {"Zm9vYmFy", "foobar"},
                                    {"Zg==Zm8=", "ffo"},
                                    {"Zg", "f"}})
    EXPECT_EQ(decode_base64(text), bytes);
  EXPECT_ERROR(Error, "'*' in base64", decode_base64("Zm9v*"));
  EXPECT_ERROR(Error, "base64 with a lone digit", decode_base64("Zm9vY"));
}

TEST(VtkArrays, SizesAreNeverTrusted) {
  const std::string bytes("\xff\xff\xff\x7f\1\2\3\4", 8);
  EXPECT_ERROR(Error, "an array of 2147483647 bytes, and 4 are left", unpack_vtk_array(bytes, {}));
  EXPECT_ERROR(Error, "2147483647 compressed blocks", unpack_vtk_array(bytes + bytes, {.compressed = true}));
  const std::string block("\1\0\0\0\xff\xff\xff\x7f\xff\xff\xff\x7f\3\0\0\0abc", 19);
  EXPECT_ERROR(Error, "a compressed block of 3 bytes is to hold 2147483647",
               unpack_vtk_array(block, {.compressed = true}));
  EXPECT_ERROR(Error, "an array without its size", unpack_vtk_array("\1", {}));
  EXPECT_ERROR(Error, "an array of 3 bytes; expected a multiple of 4", integers_of("abc", "Int32", false));
  EXPECT_ERROR(Error, "an array of type 'String'", reals_of("abc", "String", false));
  EXPECT_EQ(integers_of(std::string("\0\1", 2), "Int16", true), std::vector<long long>{1});
}

}  // namespace hooke::vtp_test
