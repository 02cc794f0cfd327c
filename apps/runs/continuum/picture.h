#pragma once

#include "fem/solid/solid.h"
#include "postprocess/pictures/field_picture.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace apps
{
  /** A solid cut through, as it is now. */
  struct SolidCut
  {
    std::vector<postprocess::PictureFacet> facets; ///< their value: displacement in the plane of the cut [m]
    int                                    right = 0, up = 1, across = 2; ///< axes
    double                                 position = 0;                  ///< along `across`, in three dimensions [m]
    bool                                   in_space = false;
  };

  /**
   * All of a plane solid; one in space across an axis. On one rank.
   *
   * @param through the cut passes as near to it as elements let it [m]; without, where the solid moves most
   */
  template <int dim>
  SolidCut cut_of(const fem::Solid<dim>       &solid,
                  const fem::Vector           &displacement,
                  unsigned int                 across  = 1,
                  const std::optional<double> &through = std::nullopt);

  /** The axis along which a solid in space moves least: a cut across it shows how it moves. On one rank. */
  unsigned int calmest_axis(const fem::Solid<3> &solid, const fem::Vector &displacement);

  /**
   * Draw a cut as it is, coloured by displacement. @param circles particles that it meets
   * @return what went wrong, "" if nothing
   */
  std::string draw_cut(const std::filesystem::path            &file,
                       const SolidCut                         &cut,
                       const std::string                      &title,
                       std::vector<postprocess::PictureCircle> circles = {});

  /**
   * Draw the damage of a solid, deformed and magnified: all elements in two dimensions; in three a section, in the plane of the
   * direction that moves most and the longest of the others, where most is damaged.
   *
   * Every rank calls it; the first one draws. Nothing is drawn where no material can be damaged.
   * @return what went wrong, "" if nothing.
   */
  template <int dim>
  std::string draw_damage(fem::Solid<dim>             &solid,
                          const fem::Vector           &displacement,
                          const std::filesystem::path &file,
                          const std::string           &title);

  /**
   * Draw which points of a solid are cells whose particles have taken over, coloured by the state in which they did, undeformed; in three
   * dimensions those of the elements that a section meets, as for damage.
   *
   * Every rank calls it; the first one draws. Nothing is drawn where none has.
   * @return what went wrong, "" if nothing.
   */
  template <int dim>
  std::string draw_promotion(fem::Solid<dim>             &solid,
                             const fem::Vector           &displacement,
                             const std::filesystem::path &file,
                             const std::string           &title);
} // namespace apps
