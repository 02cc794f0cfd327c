#pragma once

#include "apps/runs/continuum/model.h"
#include "apps/runs/continuum/solid_nodes.h"
#include "postprocess/files/series.h"

#include <memory>
#include <vector>

namespace apps
{
  /**
   * The solid of a scene in explicit motion, advanced step by step by a program, beside what the scene does to it; whatever the dimension.
   * Forces on its nodes from outside stay until clear_forces().
   */
  class MovingSolid
  {
  public:
    virtual ~MovingSolid() = default;

    virtual SolidNodes       &nodes()       = 0;
    virtual const SolidNodes &nodes() const = 0;

    /** One step of this length [s]. @throws base::InputError for one that is not above 0 or is too long; base::NumericalError also where no state after this one is worth anything */
    virtual void advance(double length) = 0;

    /** Step that a run of the scene takes now, on its way to a state this much later [s]. */
    virtual double next_step(double rest) const = 0;
    virtual double longest_step() const         = 0; ///< that is stable now, by the scene's safety [s]
    virtual double time() const                 = 0; ///< [s]

    virtual void clear_forces() = 0;

    /** Columns of the series of a run, and their values now. */
    virtual std::vector<postprocess::SeriesColumn> columns() const = 0;
    virtual std::vector<double>                    row() const     = 0;
  };

  /**
   * @param model must outlive it. start_mpi() must have been called.
   * @throws base::InputError as a run of the scene; for a static analysis, and for bodies in contact and rigid ones, which only runs move
   */
  std::unique_ptr<MovingSolid> make_moving_solid(const ContinuumModel &model);
} // namespace apps
