// Bytes of a file that were changed on a disk or on the way: what is read is what was written, or nothing.
#include "base/errors.h"
#include "postprocess/hdf5/discrete_state_hdf5.h"
#include "postprocess/packings/packing_hdf5.h"
#include "scratch_folder.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <functional>

using postprocess_tests::content_of;
using postprocess_tests::ScratchFolder;

namespace
{
  /// Reads a file and writes what it found there to another.
  using Copy = std::function<void(const std::filesystem::path &from, const std::filesystem::path &to)>;

  void copy_packing(const std::filesystem::path &from, const std::filesystem::path &to)
  {
    const auto [packing, metadata] = postprocess::read_packing_hdf5(from);
    postprocess::write_packing_hdf5(packing, to, metadata);
  }

  void copy_state(const std::filesystem::path &from, const std::filesystem::path &to)
  {
    postprocess::write_discrete_state(postprocess::read_discrete_state(from), to);
  }

  struct Outcomes
  {
    int same = 0, refused = 0, other = 0;
  };

  /// Damage done at each of the places in turn, by one hand: what comes of it.
  Outcomes outcomes(const ScratchFolder                                   &folder,
                    const std::string                                     &sound,
                    const std::vector<std::size_t>                        &places,
                    const std::function<void(std::string &, std::size_t)> &damage,
                    const Copy                                            &copy)
  {
    Outcomes found;
    for (const std::size_t at : places)
      {
        std::string content = sound;
        damage(content, at);
        if (content == sound)
          continue;
        try
          {
            copy(folder.file("damaged.h5", content), folder / "copy.h5");
            const bool same = content_of(folder / "copy.h5") == sound; // equal contents make equal files
            ++(same ? found.same : found.other);
          }
        catch (const base::InputError &)
          {
            ++found.refused;
          }
      }
    return found;
  }

  std::vector<std::size_t> every(const std::size_t step, const std::size_t from, const std::size_t to)
  {
    std::vector<std::size_t> places;
    for (std::size_t at = from; at < to; at += step)
      places.push_back(at);
    return places;
  }

  void zero(std::string &content, const std::size_t at, const std::size_t bytes)
  {
    std::fill_n(content.begin() + static_cast<std::ptrdiff_t>(at), std::min(bytes, content.size() - at), '\0');
  }

  void require_nothing_passes(const ScratchFolder &folder, const std::string &sound, const Copy &copy)
  {
    const Outcomes blank = outcomes(
      folder, sound, every(100, 0, sound.size()), [](std::string &c, std::size_t at) { zero(c, at, 500); }, copy);
    const Outcomes short_blank = outcomes(
      folder, sound, every(4, 0, sound.size()), [](std::string &c, std::size_t at) { zero(c, at, 8); }, copy);
    const Outcomes one_bit = outcomes(
      folder, sound, every(3, 0, sound.size()),
      [](std::string &c, std::size_t at) { c[at] = static_cast<char>(c[at] ^ (1 << at % 8)); }, copy);
    for (const Outcomes &o : {blank, short_blank, one_bit})
      {
        INFO(o.same << " read as it was, " << o.refused << " refused, " << o.other << " read as something else");
        CHECK(o.other == 0);
        CHECK(o.refused > o.same); // what nobody reads is little
      }
  }
} // namespace

TEST_CASE("a byte changed anywhere in an HDF5 packing or state is noticed, or changes nothing", "[postprocess][slow]")
{
  const ScratchFolder folder;
  SECTION("packing")
  {
    const dem::Packing packing{
      {{0, 0, 0}, {3, 0, 0}, {0, 3, 0}}, {1, 0.5, 0.25}, Eigen::Vector3d(9, 9, 9), {0, 1, 0}, {"mortar", "aggregate"}};
    postprocess::write_packing_hdf5(packing, folder / "p.h5", {{"seed", "7"}, {"packing_fraction", "0.6"}});
    require_nothing_passes(folder, content_of(folder / "p.h5"), copy_packing);
  }
  SECTION("state")
  {
    dem::DiscreteState state;
    state.time      = 1.0 / 3.0;
    state.reference = state.position = {{0, 0, 0}, {1e-3, 0, 0}};
    state.radius                     = {1e-3, 2e-3};
    state.volume                     = {1e-9, 2e-9};
    state.held                       = {0, 1};
    state.stress.assign(2, 1e6 * Eigen::Matrix3d::Identity());
    state.damage.ends    = {{0, 1}};
    state.damage.links   = {{{1, 0, 0}, 0.25}};
    state.damage.contact = {{5e-4, 0, 0}};
    postprocess::write_discrete_state(state, folder / "s.h5");
    require_nothing_passes(folder, content_of(folder / "s.h5"), copy_state);
  }
}

TEST_CASE("a list of chunks that was blanked does not become a packing of zeros", "[postprocess][slow]")
{
  const ScratchFolder folder;
  dem::Packing        packing;
  for (int i = 0; i < 50000; ++i) // centres lie in two chunks
    {
      packing.centre.push_back({3.0 * i, 0, 0});
      packing.radius.push_back(1);
      packing.material.push_back(i % 2);
    }
  postprocess::write_packing_hdf5(packing, folder / "p.h5", {});
  const std::string        sound = content_of(folder / "p.h5");
  std::vector<std::size_t> lists;
  for (const std::string name : {"TREE", "FAHD", "FADB"})
    for (std::size_t at = sound.find(name); at != std::string::npos; at = sound.find(name, at + 1))
      for (const std::size_t place : every(8, at, std::min(at + 120, sound.size())))
        lists.push_back(place);
  REQUIRE(lists.size() > 20);
  const Outcomes o = outcomes(
    folder, sound, lists, [](std::string &c, std::size_t at) { zero(c, at, 8); }, copy_packing);
  INFO(o.same << " read as it was, " << o.refused << " refused, " << o.other << " read as something else");
  CHECK(o.other == 0);
  CHECK(o.refused > 10);
}
