#pragma once

#include "fem/mesh/mesh.h"

#include <Eigen/Geometry>

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace coupling
{
  /**
   * The elements of a mesh before any of them has gone, by their numbers, so that sets of them can be a region of particles. Every
   * rank has all of it.
   */
  class MeshElements
  {
  public:
    using Set = std::set<unsigned int>;

    virtual ~MeshElements() = default;

    virtual std::vector<std::string> groups() const = 0; ///< names of groups of elements
    /** @throws base::InputError for a group that the mesh does not have */
    virtual Set of_group(const std::string &group) const = 0;
    /** All of whose corners are such places. */
    virtual Set within(const std::function<bool(const Eigen::Vector3d &)> &is_such) const = 0;
    /** These, and those all of whose corners are theirs: they could not be left of a mesh without them. */
    virtual Set filled(const Set &elements) const = 0;
    /** With a corner at one of these places, and those with a corner nearer to one of such an element than a distance [m]. */
    virtual Set around(const std::vector<Eigen::Vector3d> &places, double distance) const = 0;
    virtual std::vector<Eigen::AlignedBox3d> boxes_of(const Set &elements) const          = 0; ///< around each [m]
    virtual Eigen::Vector3d                  centre_of(unsigned int element) const        = 0;
    /** The element that has its centre there. @pre there is one */
    virtual unsigned int with_centre(const Eigen::Vector3d &place) const = 0;

    /**
     * Distance of a place from a set, negative inside [m]: from the faces that it shares with other elements, free surfaces are no ends of
     * it. @param name of the set, for messages @throws base::InputError for one without such faces
     */
    virtual std::function<double(const Eigen::Vector3d &)> distance_from(const Set         &elements,
                                                                         const std::string &name) const = 0;
  };

  /** @param mesh that every rank has the whole of */
  template <int dim>
  std::unique_ptr<MeshElements> elements_of(fem::Mesh<dim> mesh);
} // namespace coupling
