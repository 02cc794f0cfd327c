#pragma once

#include "coupling/volume/overlap.h"
#include "coupling/volume/turning.h"
#include "dem/network/elastic_network.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/SparseCore>

#include <functional>
#include <vector>

namespace coupling
{
  /**
   * That part of a bond between a free and a constrained particle which lies in elements. These have their whole stiffness there, so that it
   * is double-counted and has to be subtracted (doc/theory/volume-coupling.md, 5).
   */
  struct BondEnd
  {
    Eigen::Vector3d from, to;        ///< where the bond enters the elements, where the constrained particle is [m]
    std::size_t     constrained = 0; ///< the constrained particle, by packing number
    double          part        = 0; ///< of the bond's length [-]
    double          arm = 0; ///< from the constrained particle to the point where the bond acts, as the bond has it [m]
    Eigen::Matrix3d stiffness; ///< of that part: force over slip, as ElasticLink has it [N/m]
    Eigen::Matrix3d turning;   ///< moment over relative rotation, likewise [N m]
  };

  /**
   * Of all bonds between constrained particles and others.
   * @param constrained the constrained particles, by packing number, all of them in elements and in the overlap @param in_elements whether a place is
   */
  std::vector<BondEnd> bond_ends(const dem::ElasticNetwork                          &network,
                                 const std::vector<std::size_t>                     &constrained,
                                 const Overlap                                      &overlap,
                                 const std::function<bool(const Eigen::Vector3d &)> &in_elements);

  /**
   * Stiffness of all ends against displacements of the nodes, three for each: ends move and turn as elements do there.
   * @param entries row, node, weight and gradient of places: of each end first `from`, then `to`
   * @param node of an entry, its number
   */
  template <typename Entries, typename NodeOf>
  Eigen::SparseMatrix<double>
  stiffness_of(const std::vector<BondEnd> &ends, const Entries &entries, const std::size_t nodes, const NodeOf &node)
  {
    // Slip and relative rotation of each end, by displacements: under even strain force and couple of the bond on its constrained particle then vanish.
    std::vector<Eigen::Triplet<double>> by_nodes, of_ends;
    const auto add = [](auto &triplets, const std::size_t row, const std::size_t column, const Eigen::Matrix3d &block) {
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
          if (block(r, c) != 0)
            triplets.emplace_back(static_cast<int>(3 * row) + r, static_cast<int>(3 * column) + c, block(r, c));
    };
    const auto across = [](const Eigen::Vector3d &v) {
      Eigen::Matrix3d m;
      m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
      return m;
    };
    for (const auto &e : entries)
      {
        const BondEnd        &end   = ends[e.row / 2];
        const double          side  = e.row % 2 == 0 ? -1 : 1;
        const Eigen::Matrix3d spin  = 0.5 * across(e.gradient);
        const Eigen::Vector3d whole = end.to - end.from, of_constrained = end.arm * whole.normalized(),
                              lever = e.row % 2 == 0 ? Eigen::Vector3d(whole - of_constrained) : of_constrained;
        add(by_nodes, 2 * (e.row / 2), node(e), side * e.weight * Eigen::Matrix3d::Identity() + across(lever) * spin);
        add(by_nodes, 2 * (e.row / 2) + 1, node(e), side * spin);
      }
    for (std::size_t k = 0; k < ends.size(); ++k)
      {
        add(of_ends, 2 * k, 2 * k, ends[k].stiffness);
        add(of_ends, 2 * k + 1, 2 * k + 1, ends[k].turning);
      }
    const auto                  rows = static_cast<Eigen::Index>(6 * ends.size());
    Eigen::SparseMatrix<double> slip(rows, static_cast<Eigen::Index>(3 * nodes)), own(rows, rows);
    slip.setFromTriplets(by_nodes.begin(), by_nodes.end());
    own.setFromTriplets(of_ends.begin(), of_ends.end());
    return Eigen::SparseMatrix<double>(slip.transpose() * own * slip);
  }

  /** The ends of a bond's part: where it enters the elements, and the constrained particle, as they are now. */
  struct EndNow
  {
    Eigen::Vector3d from, to; ///< places [m]
    Eigen::Matrix3d turn_from, turn_to;
  };

  /** Slopes of the energy of a part with the places and the turns of its ends. */
  struct EndPulls
  {
    Eigen::Vector3d force; ///< with the place of the constrained particle; with the other end's it is the opposite [N]
    Eigen::Vector3d couple_from, couple_to; ///< [N m]
    double          energy = 0;             ///< [J]
  };

  /** Of a link whose ends turn as far as they like: none of a motion as a whole; of small ones those of stiffness_of(). */
  EndPulls pulls_of(const BondEnd &end, const EndNow &now);

  /** Slopes of the energy of all ends with the places of nodes [N]. @param nodes where they are now [m] */
  template <typename Entries>
  CarrierRows
  slopes_of(const std::vector<BondEnd> &ends, const Entries &entries, const CarrierRows &nodes, const int dimension)
  {
    const PlacesNow       now = places_now(entries, 2 * ends.size(), nodes, dimension);
    std::vector<EndPulls> pulls;
    for (std::size_t k = 0; k < ends.size(); ++k)
      pulls.push_back(pulls_of(
        ends[k], {now.place[2 * k], now.place[2 * k + 1], now.turn[2 * k].rotation, now.turn[2 * k + 1].rotation}));
    CarrierRows slopes = CarrierRows::Zero(nodes.rows(), 3);
    for (const auto &e : entries)
      {
        const EndPulls       &pull   = pulls[e.row / 2];
        const bool            enters = e.row % 2 == 0;
        const Eigen::Vector3d force  = (enters ? -e.weight : e.weight) * pull.force,
                              turns  = now.turn[e.row].force_of(enters ? pull.couple_from : pull.couple_to, e.gradient);
        slopes.row(static_cast<Eigen::Index>(e.node)) += (force + turns).transpose();
      }
    return slopes;
  }
} // namespace coupling
