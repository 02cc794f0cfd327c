// Files of a solid for ParaView.
#include "fem/output/snapshot.h"
#include "tests/fem/solid_fixture.h"

#include <unistd.h>

#include <filesystem>

TEST_CASE("snapshot: a disk that is full is said with the file's name", "[fem][S14]")
{
  Model<2>    model(box<2>({1, 1}, {2, 2}), fem::ElementFamily::hypercube, {}, elastic(1e9, 0.2),
                    hold_all<2>([](const auto &, double) { return dealii::Tensor<1, 2>(); }));
  fem::Vector none = model.solid.make_vector();
  none.update_ghost_values();
  const auto folder = std::filesystem::temp_directory_path() / ("breccia-snapshot-" + std::to_string(getpid()));
  std::filesystem::create_directory(folder);
  const auto write = [&](const std::string &where) {
    return fem::write_snapshot(model.solid, none, none, where, "solid", 7);
  };
  CHECK(write(folder.string()) == "solid_000007.vtu");
  std::filesystem::remove(folder / "solid_000007.vtu");
  std::filesystem::create_symlink("/dev/full", folder / "solid_000007.vtu"); // takes every byte and keeps none
  CHECK_THROWS_WITH(write(folder.string()), Catch::Contains("solid_000007.vtu: cannot be written"));
  CHECK_THROWS_WITH(write((folder / "missing").string()), Catch::Contains("cannot be written"));
  std::filesystem::remove(folder / "solid_000007.vtu");
  std::filesystem::remove(folder);
}
