#include "apps/specimens/written_state.h"

#include "apps/process/mpi_session.h"
#include "dem/specimen/observation.h"
#include "postprocess/hdf5/discrete_state_hdf5.h"

#include <optional>

namespace apps
{
  void write_state(const dem::ObservedSpecimen &specimen, const std::filesystem::path &file)
  {
    std::optional<postprocess::DiscreteStateFile> state;
    on_first_rank([&] { state.emplace(file, specimen.parameters().physics.dimension, specimen.time()); });
    dem::each_column(specimen, [&](const dem::StateColumn column, const std::vector<double> &numbers) {
      on_first_rank([&] { state->write(column, numbers); });
    });
    on_first_rank([&] { state->commit(); });
  }
} // namespace apps
