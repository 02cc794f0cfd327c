#pragma once

#include "apps/runs/continuum/model.h"
#include "apps/runs/continuum/probes.h"
#include "base/state.h"
#include "fem/explicit/explicit_solver.h"
#include "fem/solvers/step_control.h"

#include <functional>
#include <map>
#include <string>

namespace apps
{
  /** An analysis of a solid, static or explicit, as a run drives and records it. All ranks call each function together. */
  template <int dim>
  class ContinuumAnalysis
  {
  public:
    virtual ~ContinuumAnalysis() = default;

    /**
     * Go on, but not past the next state to record.
     * @return whether that state is reached; false: half-way, where a run may be interrupted too
     * @throws fem::NoEquilibrium, fem::MaterialFailure; the last recorded state still stands.
     */
    virtual bool advance() = 0;

    virtual bool finished() const = 0;

    virtual SolidState      state() const      = 0;
    virtual ContinuumEnergy energy() const     = 0; ///< all but what is stored, which probes read
    virtual double          coordinate() const = 0; ///< time, controlled opening or length of arc: it only grows
    virtual double          end() const        = 0; ///< of the coordinate

    /** Columns of the series that only this analysis has, and their values. */
    virtual std::vector<postprocess::SeriesColumn> columns() const = 0;
    virtual std::vector<double>                    values() const  = 0;

    virtual std::string details() const = 0; ///< for the progress line

    /** Numbers and words for "cost" in the summary. */
    virtual std::map<std::string, double> cost() const          = 0;
    virtual std::string                   linear_solver() const = 0; ///< "" if there is none

    /** How bodies have touched; nullptr where none can. */
    virtual const ContactFigures *contact_figures() const { return nullptr; }

    /** What has ended it before its end; "": nothing. */
    virtual std::string ended_by() const { return ""; }
    /** What a user should doubt; "": nothing. */
    virtual std::string warning() const { return ""; }

    /** The solver of a static analysis; nullptr of others. */
    virtual fem::StaticSolver<dim> *static_solver() { return nullptr; }
    /** Who is told how far an iteration of that solver is which belongs to no step of advance(); {}: nobody. */
    virtual void tell_iterations_to(std::function<void(const std::string &)> /*listener*/) {}

    /** Everything to go on to the same bits, histories of the points included. Columns hold this rank's part. */
    virtual void visit_state(base::StateVisitor &visitor) = 0;
  };

  template <int dim>
  std::unique_ptr<ContinuumAnalysis<dim>> make_static_analysis(fem::Solid<dim> &solid, const ContinuumModel &model);

  template <int dim>
  std::unique_ptr<ContinuumAnalysis<dim>> make_explicit_analysis(fem::Solid<dim> &solid, const ContinuumModel &model);

  /** This rank's part of a vector, as a column of a state; after reading, the vector has the column's values. */
  void visit_vector(base::StateVisitor &visitor, const std::string &name, fem::Vector &vector);

  /** The committed histories of all points of a solid. */
  template <int dim>
  void visit_histories(base::StateVisitor &visitor, fem::Solid<dim> &solid);
} // namespace apps
