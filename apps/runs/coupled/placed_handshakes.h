#pragma once

#include "apps/runs/coupled/handshakes.h"
#include "apps/runs/coupled/particle_medium.h"
#include "coupling/volume/volume_coupling.h"
#include "dem/specimen/observation.h"
#include "fem/explicit/explicit_solver.h"
#include "fem/solid/solid.h"

#include <memory>
#include <string>
#include <vector>

namespace apps
{
  /** Where particles lie inside the elements of a solid: what their couplings are made with there, and what is doubtful about them. */
  template <int dim>
  class PlacedHandshakes
  {
  public:
    using Volumes = std::vector<std::unique_ptr<coupling::VolumeCoupling<dim>>>;

    /** @param media of the particles by group of the mesh, where they are known. Solid and motion must outlive it. */
    PlacedHandshakes(const fem::Solid<dim> &solid, const fem::ExplicitSolver<dim> &motion, const ParticleMedia &media);

    /**
     * Parameters of the coupling, by size and wave speed of the elements in its overlap; doubts are noted. To be called before its
     * particles share. @throws base::InputError where no element lies in the overlap
     */
    coupling::VolumeCouplingParameters place(const HandshakeSection &handshake, const dem::ObservedSpecimen &specimen);

    const std::vector<std::string> &doubts() const { return doubtful; }
    /** What the impedances of particles and solid reflect, whatever joins them; "" where the medium is not known. */
    std::string text_of_mismatch() const;
    /** Lines of a forecast. @param volumes of the handshakes, in the order in which they were placed */
    std::string text(const Volumes &volumes) const;

  private:
    /** Elements in an overlap. */
    struct Elements
    {
      double size       = 0; ///< edge of their mean volume [m]; 0: there are none
      double wave_speed = 0; ///< of compression, in the stiffest [m/s]
    };

    Elements elements_in(const coupling::Overlap &overlap) const;
    void     find_doubts(const HandshakeSection      &handshake,
                         const dem::ObservedSpecimen &specimen,
                         const coupling::Overlap     &overlap,
                         double                       element_size);
    /** The larger reflections of what is known and of this, where elements are of that number. */
    void add_mismatch(coupling::Mismatch             &worst,
                      const coupling::ParticleMedium &medium,
                      dealii::types::material_id      number) const;
    bool reaches(dealii::types::material_id number, const coupling::Overlap &overlap) const;

    const fem::Solid<dim>          &solid;
    const fem::ExplicitSolver<dim> &motion;
    ParticleMedia                   media;
    std::vector<std::string>        names, doubtful; ///< of handshakes
    std::vector<coupling::Mismatch> mismatches;      ///< likewise
  };
} // namespace apps
