#include "apps/runs/coupled/placed_handshakes.h"

#include "base/errors.h"
#include "coupling/volume/overlap_medium.h"
#include "fem/mesh/point_in_space.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace
  {
    /** Energy that different media reflect, beyond which a scene is doubted. */
    constexpr double largest_mismatch = 0.01;
    /** Of what an overlap should be wide, likewise: rounding apart. */
    constexpr double narrowest = 0.99;

    std::string text_of(const coupling::Mismatch &mismatch, const char *how_well)
    {
      return fmt::format("impedances reflect {}{:.2g} of the energy of waves of compression, {:.2g} of shear", how_well,
                         mismatch.compression, mismatch.shear);
    }
  } // namespace

  template <int dim>
  PlacedHandshakes<dim>::PlacedHandshakes(const fem::Solid<dim>          &elements,
                                          const fem::ExplicitSolver<dim> &in_motion,
                                          const ParticleMedia            &known)
    : solid(elements)
    , motion(in_motion)
    , media(known)
  {
  }

  template <int dim>
  coupling::VolumeCouplingParameters PlacedHandshakes<dim>::place(const HandshakeSection      &handshake,
                                                                  const dem::ObservedSpecimen &specimen)
  {
    const coupling::Overlap overlap  = handshake.overlap();
    const Elements          elements = elements_in(overlap);
    if (elements.size == 0)
      throw base::InputError(
        "Handshakes/" + handshake.name +
        ": no element of the solid lies in the overlap. Widen it, or compare it with the place of the mesh.");
    names.push_back(handshake.name);
    find_doubts(handshake, specimen, overlap, elements.size);
    return handshake.parameters(elements.size, elements.wave_speed);
  }

  template <int dim>
  typename PlacedHandshakes<dim>::Elements PlacedHandshakes<dim>::elements_in(const coupling::Overlap &overlap) const
  {
    // Of the elements whose centre lies in the overlap or within; where it is narrower than they are, of those that reach into it.
    double      volume = 0, fastest = 0;
    std::size_t count = 0;
    const auto  enter = [&](const auto &cell) {
      volume += cell->measure();
      ++count;
      const auto &d = solid.material(cell->material_id()).elastic_stiffness();
      fastest       = std::max(fastest, std::sqrt(d.template topLeftCorner<3, 3>().diagonal().maxCoeff() /
                                                   motion.density(cell->material_id())));
    };
    for (const auto &cell : solid.mesh().triangulation->active_cell_iterators())
      if (overlap.distance(fem::in_space(cell->center())) <= overlap.width)
        enter(cell);
    const bool narrow = count == 0;
    for (const auto &cell : solid.mesh().triangulation->active_cell_iterators())
      if (const auto corners = cell->vertex_indices();
          narrow && std::any_of(corners.begin(), corners.end(),
                                [&](const unsigned int v) { return overlap.contains(fem::in_space(cell->vertex(v))); }))
        enter(cell);
    return {count == 0 ? 0.0 : std::pow(volume / static_cast<double>(count), 1.0 / dim), fastest};
  }

  template <int dim>
  void PlacedHandshakes<dim>::find_doubts(const HandshakeSection      &handshake,
                                          const dem::ObservedSpecimen &specimen,
                                          const coupling::Overlap     &overlap,
                                          const double                 element_size)
  {
    std::vector<double> masses;
    for (std::size_t i = 0; i < specimen.counts().particles; ++i)
      masses.push_back(specimen.particle(i).mass);
    const coupling::OverlapMedium found = coupling::medium_in_overlap(specimen.network(), masses, solid, overlap);
    const std::string             name  = "Handshakes/" + handshake.name;
    const bool                    tied  = handshake.method == coupling::VolumeMethod::multipliers;
    const double                  needs = tied ? element_size : found.longest_bond;
    if (found.density > 0 && handshake.width < narrowest * needs)
      doubtful.push_back(fmt::format("{}: Overlap = {:g} m is narrower than {}, {:.3g} m", name, handshake.width,
                                     tied ? "an element there" : "the bonds of its particles are long", needs));
    coupling::Mismatch worst;
    for (const auto &[group, number] : solid.mesh().materials)
      if (const coupling::ParticleMedium *known = media.of(group);
          reaches(number, overlap) && (known || found.density > 0))
        add_mismatch(worst, known ? *known : coupling::ParticleMedium{found.stiffness, found.density}, number);
    mismatches.push_back(worst);
    if (std::max(worst.compression, worst.shear) > largest_mismatch)
      doubtful.push_back(fmt::format("{}: the solid's stiffness or density is not that of the particles in the "
                                     "overlap: {}",
                                     name, text_of(worst, "about ")));
  }

  template <int dim>
  void PlacedHandshakes<dim>::add_mismatch(coupling::Mismatch              &worst,
                                           const coupling::ParticleMedium  &medium,
                                           const dealii::types::material_id number) const
  {
    const coupling::Mismatch found = coupling::reflected_by_mismatch(
      medium, solid.material(number).elastic_stiffness(), motion.density(number), {dim, solid.options().plane});
    worst.compression = std::max(worst.compression, found.compression);
    worst.shear       = std::max(worst.shear, found.shear);
  }

  template <int dim>
  bool PlacedHandshakes<dim>::reaches(const dealii::types::material_id number, const coupling::Overlap &overlap) const
  {
    for (const auto &cell : solid.mesh().triangulation->active_cell_iterators())
      if (cell->material_id() == number &&
          overlap.distance(fem::in_space(cell->center())) <= overlap.width + cell->diameter())
        return true;
    return false;
  }

  template <int dim>
  std::string PlacedHandshakes<dim>::text_of_mismatch() const
  {
    if (media.empty())
      return "";
    coupling::Mismatch worst;
    for (const auto &[group, number] : solid.mesh().materials)
      if (const coupling::ParticleMedium *medium = media.of(group))
        add_mismatch(worst, *medium, number);
    return text_of(worst, "");
  }

  template <int dim>
  std::string PlacedHandshakes<dim>::text(const Volumes &volumes) const
  {
    std::string text;
    if (!media.empty())
      text += fmt::format("  medium       {}\n", text_of_mismatch());
    for (std::size_t i = 0; i < volumes.size(); ++i)
      text += fmt::format("  handshake    {}: {} particles and {} bonds in the overlap, {} nodes; {}\n", names[i],
                          volumes[i]->in_overlap(), volumes[i]->bonds(), volumes[i]->nodes(),
                          text_of(mismatches[i], "about "));
    for (const std::string &doubt : doubtful)
      text += fmt::format("  warning      {}\n", doubt);
    return text;
  }

  template class PlacedHandshakes<2>;
  template class PlacedHandshakes<3>;
} // namespace apps
