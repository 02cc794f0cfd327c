#pragma once

#include "apps/results/run_state.h"
#include "apps/runs/peridynamic_core/model.h"
#include "apps/runs/peridynamics/results.h"
#include "postprocess/files/series.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace apps
{
  /** How large a body of elements with a peridynamic core is, and the steps that it takes. */
  struct PeridynamicCoreSize
  {
    std::size_t elements = 0, unknowns = 0, nodes = 0, bonds = 0;
    std::size_t nodes_in_overlap = 0, mesh_nodes = 0; ///< of the core and of the mesh, that are tied to each other
    double      solid_step = 0, core_step = 0;        ///< that either could take alone [s]
  };

  /** Elements around a peridynamic core, in motion, as a run drives and records them; whatever the dimension. */
  class PeridynamicCoreBody
  {
  public:
    virtual ~PeridynamicCoreBody() = default;

    /** At least one step, up to this time; fewer when interrupted. @throws StoppedShort, base::NumericalError */
    virtual void advance_to(double time) = 0;
    /** So many of the longest steps, before the end. @return how many */
    virtual std::int64_t advance(std::int64_t steps) = 0;

    virtual double       time() const  = 0; ///< [s]
    virtual std::int64_t steps() const = 0; ///< taken
    virtual double       step() const  = 0; ///< the longest now [s]

    virtual std::vector<postprocess::SeriesColumn> columns() const  = 0; ///< of the series; the first is the time
    virtual std::vector<double>                    row() const      = 0;
    virtual std::vector<postprocess::SeriesColumn> reported() const = 0; ///< columns that the summary reports

    virtual PeridynamicCoreSize      size() const   = 0;
    virtual const PeridynamicBody   &core() const   = 0;
    virtual PeridynamicState         state() const  = 0; ///< of the core
    virtual std::vector<std::string> doubts() const = 0; ///< a sentence each
    /** What the impedances of elements and core reflect of the energy of waves along an axis. */
    virtual std::string text_of_mismatch() const = 0;
    virtual std::string first_reaction() const   = 0; ///< name of a column; "": there is none

    /** @param number of the snapshot. @throws postprocess::OutputError */
    virtual void write_solid(const std::filesystem::path &folder, std::size_t number) = 0;
    /** Elements and core in one picture, displacements magnified. @return what went wrong, "" if nothing */
    virtual std::string
    draw(const std::filesystem::path &file, const std::string &title, PeridynamicState::Shown shown) const = 0;

    virtual void visit_state(RunState &state) = 0;
  };

  /** @param model must outlive the body @throws base::InputError */
  std::unique_ptr<PeridynamicCoreBody> make_peridynamic_core_body(const PeridynamicCoreModel &model);
} // namespace apps
