#include "apps/runs/coupled/pictures.h"

#include "apps/runs/continuum/picture.h"
#include "apps/specimens/specimen_picture.h"
#include "postprocess/pictures/specimen_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace apps
{
  using Eigen::Vector3d;

  namespace
  {
    /** Particles that a cut meets. */
    std::vector<postprocess::PictureCircle> circles_in(const SolidCut &cut, const dem::ParticleOutput &particles)
    {
      std::vector<postprocess::PictureCircle> circles;
      for (std::size_t i = 0; i < particles.position.size(); ++i)
        {
          const Vector3d &at    = particles.position[i];
          const double    off   = cut.in_space ? at[cut.across] - cut.position : 0.0;
          const double    round = particles.radius[i] * particles.radius[i] - off * off;
          if (round > 0)
            circles.push_back({{at[cut.right], at[cut.up]}, std::sqrt(round)});
        }
      return circles;
    }
  } // namespace

  template <int dim>
  std::string draw_solid_and_particles(const fem::Solid<dim>       &solid,
                                       const fem::Vector           &displacement,
                                       const dem::ParticleOutput   &particles,
                                       const std::filesystem::path &file,
                                       const std::string           &title)
  {
    SolidCut                                cut     = cut_of(solid, displacement);
    std::vector<postprocess::PictureCircle> circles = circles_in(cut, particles);
    if (circles.empty() && !particles.position.empty() && dim == 3)
      {
        const auto place   = [&cut](const Vector3d &x) { return x[cut.across]; };
        const auto nearest = std::min_element(
          particles.position.begin(), particles.position.end(), [&](const Vector3d &a, const Vector3d &b) {
            return std::fabs(place(a) - cut.position) < std::fabs(place(b) - cut.position);
          });
        cut     = cut_of(solid, displacement, static_cast<unsigned int>(cut.across), place(*nearest));
        circles = circles_in(cut, particles);
      }
    return draw_cut(file, cut, title, std::move(circles));
  }

  template <int dim>
  std::string draw_cracks_in_solid(const fem::Solid<dim>       &solid,
                                   const fem::Vector           &displacement,
                                   const DrawnCracks           &cracks,
                                   const std::filesystem::path &file,
                                   const std::string           &title)
  {
    postprocess::PictureSlab slab;
    slab.magnify         = magnification(cracks.particles);
    slab.materials       = cracks.material_names;
    slab.classes         = cracks.link_classes;
    fem::Vector enlarged = displacement;
    enlarged *= slab.magnify;
    enlarged.update_ghost_values();
    const SolidCut cut = cut_of(solid, enlarged);
    slab.axis          = cut.across;
    for (const postprocess::PictureFacet &facet : cut.facets)
      {
        auto &corners = slab.bodies.emplace_back();
        for (const auto &corner : facet.corner)
          corners.emplace_back(corner[0], corner[1]);
      }
    return postprocess::picture_of_specimen(file, cracks.particles, cracks.links,
                                            fmt::format("{}, displacements x {}", title, slab.magnify), slab);
  }

#define BRECCIA_INSTANTIATE(dim)                                                                                       \
  template std::string draw_solid_and_particles(const fem::Solid<dim> &, const fem::Vector &,                          \
                                                const dem::ParticleOutput &, const std::filesystem::path &,            \
                                                const std::string &);                                                  \
  template std::string draw_cracks_in_solid(const fem::Solid<dim> &, const fem::Vector &, const DrawnCracks &,         \
                                            const std::filesystem::path &, const std::string &);
  BRECCIA_INSTANTIATE(2)
  BRECCIA_INSTANTIATE(3)
#undef BRECCIA_INSTANTIATE
} // namespace apps
