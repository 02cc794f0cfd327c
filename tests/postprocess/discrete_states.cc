#include "base/errors.h"
#include "postprocess/hdf5/discrete_state_hdf5.h"
#include "postprocess/hdf5/hdf5_file.h"
#include "scratch_folder.h"

#include <catch2/catch.hpp>

using Catch::Matchers::Contains;
using postprocess_tests::ScratchFolder;

namespace
{
  dem::DiscreteState sample()
  {
    dem::DiscreteState state;
    state.time      = 1.0 / 3.0;
    state.reference = {{0, 0, 0}, {1e-3, 0, 0}, {0, 2e-3, 0.1}};
    state.position  = {{0, 0, 1e-9}, {1.1e-3, 0, 0}, {0, 2e-3, 0.3}};
    state.radius    = {1e-3, 2e-3, 1e-3 / 3};
    state.volume    = {1e-9, 2e-9, 3e-9};
    state.held      = {0, 1, 0};
    for (int p = 0; p < 3; ++p)
      {
        Eigen::Matrix3d s;
        s << 1, 2, 3, 2, 4, 5, 3, 5, 6;
        state.stress.push_back(1e6 / (p + 3) * s);
      }
    state.damage.ends    = {{0, 1}, {1, 2}};
    state.damage.links   = {{{1, 0, 0}, 0.25}, {{0, 0.6, 0.8}, 1}};
    state.damage.contact = {{5e-4, 0, 0}, {0, 1e-3, 0}};
    return state;
  }
} // namespace

TEST_CASE("a discrete state comes back to the last bit", "[postprocess]")
{
  const ScratchFolder      folder;
  const dem::DiscreteState written = sample();
  postprocess::write_discrete_state(written, folder / "state.h5");
  const dem::DiscreteState read = postprocess::read_discrete_state(folder / "state.h5");
  CHECK(read.time == written.time);
  CHECK(read.dimension == 3);
  CHECK(read.reference == written.reference);
  CHECK(read.position == written.position);
  CHECK(read.radius == written.radius);
  CHECK(read.volume == written.volume);
  CHECK(read.held == written.held);
  CHECK(read.stress == written.stress);
  CHECK(read.damage.ends == written.damage.ends);
  CHECK(read.damage.contact == written.damage.contact);
  for (std::size_t l = 0; l < 2; ++l)
    {
      CHECK(read.damage.links[l].direction == written.damage.links[l].direction);
      CHECK(read.damage.links[l].damage == written.damage.links[l].damage);
    }
}

TEST_CASE("a discrete state that cannot be is refused with file, item and reason", "[postprocess][S14]")
{
  const ScratchFolder folder;
  const auto          refusal = [&](const dem::DiscreteState &state) {
    postprocess::write_discrete_state(state, folder / "state.h5");
    try
      {
        postprocess::read_discrete_state(folder / "state.h5");
      }
    catch (const base::InputError &error)
      {
        return std::string(error.what());
      }
    return std::string("accepted");
  };
  auto state                   = sample();
  state.damage.links[1].damage = 1.5;
  CHECK_THAT(refusal(state), Contains("state.h5: link 2: its strength damage must lie between 0 and 1, found 1.5"));
  state                           = sample();
  state.damage.links[0].direction = {2, 0, 0};
  CHECK_THAT(refusal(state), Contains("link 1: its direction must have length 1, found 2"));
  state                = sample();
  state.damage.ends[0] = {0, 7};
  CHECK_THAT(refusal(state), Contains("link 1: its ends must be particle numbers from 0, found 7"));
  state           = sample();
  state.volume[2] = 0;
  CHECK_THAT(refusal(state), Contains("particle 3: its volume must be a finite number above zero"));
  state                 = sample();
  state.stress[0](0, 0) = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(refusal(state), Contains("particle 1: its stress must be finite"));
  state                 = sample();
  state.stress[2](1, 1) = 1e300;
  CHECK_THAT(refusal(state), Contains("particle 3: its stress must be finite numbers up to 1e15 Pa, found 1e+300"));
  state                      = sample();
  state.damage.contact[1][2] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(refusal(state), Contains("link 2: its contact point must be finite"));
  state      = sample();
  state.time = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(refusal(state), Contains("time = nan: must be a finite number"));
  state         = sample();
  state.held[1] = 5;
  CHECK_THAT(refusal(state), Contains("particle 2: its mark of being held must be 0 or 1, found 5"));
  {
    postprocess::hdf5::OutputFile file(folder / "other.h5");
    file.write_text("format", "breccia packing");
    file.commit();
  }
  CHECK_THROWS_WITH(postprocess::read_discrete_state(folder / "other.h5"),
                    Contains("other.h5: is not a discrete state"));
}
