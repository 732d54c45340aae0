// Optimizes a mesh file: INPUT OUTPUT, with edge flips.
#include <hooke/core/error.h>
#include <hooke/io/read_mesh.h>
#include <hooke/io/write_mesh.h>
#include <hooke/remesh/preserving_remesh.h>
#include <hooke/springs/sizing.h>

#include <iostream>

int main(int, char** argv) try {
  hooke::LoadedMesh input = hooke::read_mesh(argv[1]);
  hooke::set_target_lengths(input.mesh, input.memory_order, hooke::parse_length("auto"));
  hooke::RemeshOptions options;
  options.connectivity = hooke::ConnectivityMode::flip;
  options.effort = hooke::Effort::fast;
  const hooke::RemeshResult done = preserving_remesh(input.mesh, input.memory_order, options);
  if (!done.measures->preservation.holds()) throw hooke::ResultError("the surface is not kept");
  hooke::prepare_mesh(argv[2], input.mesh, hooke::format_of(argv[2])).file.commit();
} catch (const hooke::Error& e) {
  std::cerr << e.what() << "\n";
  return 1;
}
