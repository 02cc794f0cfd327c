#pragma once

#include "apps/runs/continuum/contacts.h"
#include "apps/runs/continuum/probes.h"
#include "apps/runs/coupled/energy_watch.h"
#include "apps/runs/coupled/model.h"
#include "apps/runs/particles/body.h"
#include "coupling/concurrent/concurrent_motion.h"
#include "coupling/participants/solid_participant.h"
#include "postprocess/files/series.h"

#include <vector>

namespace apps
{
  /** What a coupled run records is read from these, which must outlive it. */
  template <int dim>
  struct CoupledSources
  {
    const CoupledModel                    &model;
    const ParticlesBody                   &body;
    const fem::ExplicitSolver<dim>        &motion;
    const coupling::SolidParticipant<dim> &participant;
    const coupling::ConcurrentMotion<dim> &both;
    const ObservedContacts<dim>           &touching; ///< between bodies of the solid
    const ContinuumProbes<dim>            &probes;
  };

  struct CoupledRow
  {
    std::vector<double> values;
    CoupledEnergies     energies; ///< of the same moment: to find them, all links are gone through
  };

  /** The series of particles and a solid that are coupled: its columns, and a row of now. */
  template <int dim>
  class CoupledSeries
  {
  public:
    explicit CoupledSeries(const CoupledSources<dim> &sources)
      : from(sources)
    {
    }

    std::vector<postprocess::SeriesColumn> columns() const; ///< the first is the time
    /** Those that the summary reports. */
    std::vector<postprocess::SeriesColumn> reported() const;
    CoupledRow                             row(double time) const;

  private:
    std::int64_t       torn_glue() const; ///< of all couplings, since the start
    coupling::Momentum momentum() const;  ///< of all

    CoupledSources<dim> from;
  };
} // namespace apps
