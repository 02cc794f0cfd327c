#pragma once

#include "apps/runs/continuum/energy.h"
#include "apps/runs/continuum/probe_column.h"
#include "apps/runs/continuum/model.h"
#include "base/state.h"
#include "fem/solid/solid.h"

namespace apps
{
  /** State of a solid as an analysis holds it. */
  struct SolidState
  {
    const fem::Vector *displacement, *internal_force, *external_force;
  };

  /**
   * What is read from a solid after every step: resultants of loads and reactions, displacements at named points, energy
   * stored, largest damage and crack opening, and what else its materials want to have watched.
   */
  template <int dim>
  class ContinuumProbes
  {
  public:
    /** @throws base::InputError for a point outside the solid. */
    ContinuumProbes(fem::Solid<dim> &solid, const ContinuumModel &model);

    std::vector<ProbeColumn> columns() const;

    /** One value per column, the same on every rank. @param energy of the analysis, which is completed by what is stored */
    std::vector<double> read(const SolidState &state, ContinuumEnergy &energy) const;

    /** From now on the energies count from the present histories at this displacement. */
    void start_at(const fem::Vector &displacement) { stored_at_start = read_points(displacement, 0).stored; }
    void visit_state(base::StateVisitor &visitor) { visitor.scalar("stored_at_start", stored_at_start); }

    /** The first reaction column, or "". */
    std::string first_reaction() const;

  private:
    struct Resultant
    {
      std::string                                  name; ///< column
      std::vector<dealii::types::global_dof_index> dofs;
    };
    struct Displacement
    {
      std::string                                                     name;
      std::vector<std::pair<dealii::types::global_dof_index, double>> weights;
    };
    /** A quantity of histories of which the series has the largest value: by its role, or by its name. */
    struct Watched
    {
      std::string              name, unit; ///< column
      fem::PointQuantity::Role role;
      std::string              quantity;

      bool is(const fem::PointQuantity &of) const;
    };
    struct Points
    {
      double              stored = 0;
      std::vector<double> largest; ///< of each watched quantity, 0 at least
      std::vector<double> count;   ///< of points that have each counted one
    };

    /** Along components in which several boundaries or supports hold the same nodes: their sum, in which these count once. */
    void   add_totals();
    void   watch_histories();
    Points read_points(const fem::Vector &displacement, double work) const;

    fem::Solid<dim>          &solid;
    double                    stored_at_start = 0; ///< when the energies began to count [J]
    std::vector<Resultant>    loads, reactions;
    std::vector<Displacement> displacements;
    std::vector<Watched>      watched;
    std::vector<std::string>  counted; ///< quantities of which the series has the number of points
  };
} // namespace apps
