#pragma once

#include "fem/solid/solid.h"
#include "postprocess/pictures/field_picture.h"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace apps
{
  /** A facet as plain numbers, to be sent: x, y, u, v of four corners, and the value. */
  constexpr std::size_t facet_length = 17;

  /** The plane that a picture shows: two axes, and in three dimensions where it cuts the third. */
  struct PicturePlane
  {
    unsigned int right = 0, up = 1, across = 2;
    double       position = 0; ///< along `across` [m]
  };

  /** Corner of a facet: place and displacement in the plane of the picture. */
  using FacetCorner = std::array<double, 4>;

  /** As facets of four corners, in order around; a triangle repeats its last one. */
  void append_polygon(std::vector<double> &facets, const std::vector<FacetCorner> &corners, double value);

  /**
   * In three dimensions: the direction that moves most and the longest of the others, cut where most of a quantity is. All ranks together.
   * @param of_elements the quantity, of every owned element by its index
   */
  template <int dim>
  PicturePlane plane_of(const fem::Solid<dim>                &solid,
                        const fem::Vector                    &displacement,
                        const std::map<unsigned int, double> &of_elements);

  /** Owned elements, or their sections with the plane, as plain numbers. */
  template <int dim>
  std::vector<double> facets_of(const fem::Solid<dim>                &solid,
                                const fem::Vector                    &displacement,
                                const std::map<unsigned int, double> &of_elements,
                                const PicturePlane                   &plane);

  /** Of all ranks, on each. */
  std::vector<double> of_all_ranks(const std::vector<double> &mine, MPI_Comm communicator);

  /** @param magnify displacements */
  std::vector<postprocess::PictureFacet> as_facets(const std::vector<double> &all, double magnify);

  /** Words of where a section lies; "" of a plane model. */
  std::string place_of(const PicturePlane &plane, int dim);

  /** So that the largest displacement shows as a twentieth of the extent; a round number. */
  double magnification_of(const std::vector<double> &facets);
} // namespace apps
