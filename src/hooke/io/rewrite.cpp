#include "hooke/io/rewrite.h"

#include <utility>

#include "hooke/io/mesh_file.h"
#include "hooke/io/rewrite_formats.h"

namespace hooke {

bool can_rewrite(MeshFormat format) {
  return format == MeshFormat::obj || format == MeshFormat::ply || format == MeshFormat::off;
}

RewrittenMesh rewrite_mesh(std::string_view bytes, const std::string& name, MeshFormat format,
                           const Mat3X& points, bool texture_follows) {
  const std::string_view content = without_byte_order_mark(bytes);
  RewrittenMesh result = format == MeshFormat::obj   ? rewrite_obj(content, name, points, texture_follows)
                         : format == MeshFormat::ply ? rewrite_ply(content, name, points)
                                                     : rewrite_off(content, name, points);
  result.bytes.insert(0, bytes.substr(0, bytes.size() - content.size()));
  return result;
}

}  // namespace hooke
