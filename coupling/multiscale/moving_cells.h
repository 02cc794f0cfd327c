#pragma once

#include "coupling/multiscale/dealt_points.h"
#include "coupling/multiscale/localisations.h"
#include "coupling/multiscale/prepared_cell.h"
#include "dem/loading/localisation_watch.h"
#include "dem/specimen/specimen.h"
#include "fem/points/gathered_points.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace coupling
{
  /** What cells in motion are made of. */
  struct MovingCellsParameters
  {
    std::vector<dem::Packing>
                            packings; ///< at least one, periodic; points take them in turn, by their number in the mesh
    dem::LinkMaterials      materials;
    dem::SpecimenParameters specimen; ///< density, damping, interaction ratio; rotations, dimension, thickness
    std::int64_t    steps = 0; ///< of the particles in one of the solid; 0: as many as their stable step requires
    base::Stiffness stiffness =
      base::Stiffness::Zero();                ///< of the cells before anything has happened, for the solid's step [Pa]
    bool     stops_localised = true;          ///< the run ends where a cell localises
    MPI_Comm communicator    = MPI_COMM_SELF; ///< of ranks that all hold the same structure, and share its cells
  };

  /**
   * Integration points whose cells move with the solid, step by step (doc/theory/multiscale.md, 6): each is a specimen of particles in a
   * periodic cell, which is driven evenly from deformation to deformation while the solid makes a step. Explicit motion only: a cell cannot be
   * evaluated twice. The stress is that of the link forces; the contribution of the particles' motion about the cell's is reported apart.
   * Localisation is detected by where its links lose their strength: there is no tangent.
   * Cells are spread over threads and ranks as those of CellPoints.
   */
  class MovingCells : public fem::GatheredPoints
  {
  public:
    /** @throws base::InputError for spheres in plane stress, and as dem::Specimen */
    MovingCells(MovingCellsParameters parameters, fem::Plane plane);
    ~MovingCells() override;

    const char            *material_name() const override { return "cells"; }
    const base::Stiffness &elastic_stiffness() const override { return parameters.stiffness; }
    bool                   linear() const override { return false; }
    bool                   takes_large_strains() const override { return true; }
    bool                   takes_initial_state() const override { return false; }
    void                   allocate(std::size_t n_points) override;
    void                   place(std::vector<Site> sites, const Setting &setting) override;
    /** @throws base::InputError where the particles are given fewer steps than they are stable with */
    void begin_motion(double length) override;
    void gather(const std::vector<base::Voigt> &strains, bool with_tangent) override;
    void evaluate(std::size_t               point,
                  const base::Voigt        &strain,
                  const fem::ElementExtent &element,
                  bool                      with_tangent,
                  fem::PointAnswer         &answer) override;
    void commit() override {}
    void set_initial(std::size_t, const fem::InitialPointState &, const fem::ElementExtent &) override;

    std::string                      end_of_validity() const override { return localised.end_of_validity(); }
    std::vector<std::string>         notes() const override { return localised.notes(); }
    const std::vector<Localisation> &localisations() const { return localised.all(); }

    std::vector<fem::PointQuantity> quantities() const override;
    void                            visit(std::size_t point, const fem::StateColumn &column) override;
    bool                            remembers_more() const override { return true; }
    void                            visit_more(base::StateVisitor &visitor) override;
    double stored_energy(std::size_t point, const base::Voigt &strain, const base::Voigt &stress) const override;
    fem::Dissipation dissipated(std::size_t, const fem::ElementExtent &) const override { return {}; }

    /** Stress that the particles' own motion would add, - sum m v v / V, at a point now [Pa]. */
    base::Voigt inertia_part(std::size_t point) const;

  private:
    struct Point
    {
      std::unique_ptr<dem::Specimen> specimen; ///< of a point of this rank
      base::Voigt                    strain = base::Voigt::Zero(), stress = base::Voigt::Zero(); ///< last driven to
      base::Voigt                    inertia = base::Voigt::Zero();
      double                         stored  = 0; ///< elastic and kinetic energy of the particles [J/m^3]
      double                         volume  = 0; ///< at the start [m^3]
      dem::LocalisationWatch         watch;
      double                         has_localised = 0;         ///< 1: yes
      Eigen::Vector3d                normal        = {0, 0, 0}; ///< of the band, in the step in which it did; else 0
      std::string                    failure;
    };

    bool            of_discs() const { return parameters.specimen.physics.dimension == 2; }
    void            drive(Point &point, const base::Voigt &strain) const;
    void            find_localised();         ///< among answers that all ranks know
    void            read(Point &point) const; ///< stress and energy of what its particles have come to
    void            share_answers();
    static void     visit_answer(Point &point, base::StateVisitor &visitor);
    std::int64_t    least_steps(const Point &point) const; ///< in the step under way
    Eigen::Matrix3d deformation(const base::Voigt &strain) const;

    MovingCellsParameters parameters;
    DealtPoints           dealt;
    std::vector<Site>     sites;
    bool                  large_strains = false;
    double                length        = 0; ///< of the step under way [s]; 0: none
    Localisations         localised;
    std::int64_t          states = 0; ///< that the cells were driven to
    std::vector<Point>    points;
  };
} // namespace coupling
