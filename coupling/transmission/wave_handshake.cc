#include "coupling/transmission/wave_handshake.h"

namespace coupling
{
  namespace
  {
    fem::SolidOptions options_of(const WaveMethod &method, const Overlap &overlap)
    {
      fem::SolidOptions options;
      if (method.method == VolumeMethod::multipliers)
        options.share = [overlap](const std::array<double, 3> &place) {
          return overlap.of_solid(Eigen::Vector3d(place.data()));
        };
      return options;
    }
  } // namespace

  template <int dim>
  WaveContinuum<dim>::WaveContinuum(const fem::BodiesShape              &shape,
                                    std::unique_ptr<fem::MaterialPoints> material,
                                    const double                         density,
                                    const std::vector<SlidingSide>      &sides,
                                    const WaveCase                      &wave,
                                    const Overlap                       &overlap)
    : solid(fem::make_shape<dim>(shape, {fem::ElementFamily::hypercube, 0, MPI_COMM_SELF}),
            options_of(wave.method, overlap))
  {
    solid.assign(continuum_name, std::move(material));
    fem::Loads<dim> loads;
    loads.may_move_freely = true;
    for (const SlidingSide &side : sides)
      loads.displacements.push_back({side.name, side.axis, [](const dealii::Point<dim> &, double) { return 0.0; }});
    solid.set_loads(loads);
    fem::ExplicitOptions explicitly;
    explicitly.density = {{continuum_name, density}};
    explicitly.shared  = wave.nearest_masses ? fem::SharedMass::nearest : fem::SharedMass::rows;
    motion             = std::make_unique<fem::ExplicitSolver<dim>>(solid, explicitly);
    participant        = std::make_unique<SolidParticipant<dim>>(solid, *motion);
  }

  template <int dim>
  double WaveContinuum<dim>::energy() const
  {
    const ParticipantEnergy e = participant->energy();
    return e.kinetic + e.internal;
  }

  template struct WaveContinuum<2>;
  template struct WaveContinuum<3>;

  VolumeCouplingParameters coupling_of(const WaveCase &wave, const Overlap &overlap, const double speed)
  {
    const double             h = static_cast<double>(wave.element) * wave.medium.spacing;
    VolumeCouplingParameters p;
    p.name          = "interface";
    p.overlap       = overlap;
    p.method        = wave.method.method;
    p.compatibility = wave.method.compatibility;
    p.lumped        = wave.method.lumped;
    p.sharpness     = wave.method.sharpness;
    if (wave.method.absorbs)
      set_absorber(p, wave.method.proportions, h, speed);
    return p;
  }
} // namespace coupling
