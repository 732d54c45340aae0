#include "hooke/io/msh_elements.h"

namespace hooke {
namespace {

constexpr MshElementType element_types[] = {
    {15, 1, "points"},
    {1, 2, "lines"},
    {8, 3, "second-order lines"},
    {26, 4, "third-order lines"},
    {27, 5, "fourth-order lines"},
    {28, 6, "fifth-order lines"},
    {msh_triangle, 3, "triangles"},
    {9, 6, "second-order triangles"},
    {20, 9, "incomplete third-order triangles"},
    {21, 10, "third-order triangles"},
    {22, 12, "incomplete fourth-order triangles"},
    {23, 15, "fourth-order triangles"},
    {24, 15, "incomplete fifth-order triangles"},
    {25, 21, "fifth-order triangles"},
    {msh_quadrangle, 4, "quadrangles"},
    {16, 8, "incomplete second-order quadrangles"},
    {10, 9, "second-order quadrangles"},
    {36, 16, "third-order quadrangles"},
    {4, 4, "tetrahedra"},
    {11, 10, "second-order tetrahedra"},
    {29, 20, "third-order tetrahedra"},
    {30, 35, "fourth-order tetrahedra"},
    {31, 56, "fifth-order tetrahedra"},
    {5, 8, "hexahedra"},
    {17, 20, "incomplete second-order hexahedra"},
    {12, 27, "second-order hexahedra"},
    {92, 64, "third-order hexahedra"},
    {93, 125, "fourth-order hexahedra"},
    {6, 6, "prisms"},
    {18, 15, "incomplete second-order prisms"},
    {13, 18, "second-order prisms"},
    {7, 5, "pyramids"},
    {19, 13, "incomplete second-order pyramids"},
    {14, 14, "second-order pyramids"},
};

}  // namespace

const MshElementType* msh_element_type(long long code) {
  for (const MshElementType& type : element_types)
    if (type.code == code) return &type;
  return nullptr;
}

}  // namespace hooke
