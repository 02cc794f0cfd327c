#include "dem/network/elastic_network.h"

#include "base/errors.h"
#include "base/number_text.h"
#include "dem/kernels/first_order_shear.h"
#include "dem/model/cut_between.h"
#include "dem/model/particles.h"
#include "dem/neighbours/cell_list.h"
#include "dem/network/waiting_contacts.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace dem
{
  namespace
  {
    void require(const bool holds, const char *entry, const double value, const char *rule)
    {
      if (!holds)
        throw base::InputError(std::string(entry) + " = " + base::number_text(value) + ": " + rule);
    }

    void check_links(const NetworkParameters &p)
    {
      require(p.dimension == 2 || p.dimension == 3, "Dimension", p.dimension, "must be 2 or 3.");
      require(p.interaction_ratio >= 1 && p.interaction_ratio <= 10, "Interaction ratio", p.interaction_ratio,
              "must be from 1, the ratio at which touching particles link, to 10.");
      require(p.dimension == 3 || (p.thickness > 0 && std::isfinite(p.thickness)), "Thickness", p.thickness,
              "discs must be thicker than 0 m.");
      require(p.contact_reach >= 0 && p.contact_reach <= 1, "Contact reach", p.contact_reach, "must be from 0 to 1.");
    }

    void check(const NetworkParameters &p)
    {
      check_links(p);
      require(p.normal_modulus > 0 && std::isfinite(p.normal_modulus), "Normal modulus", p.normal_modulus,
              "must be above 0 Pa.");
      require(p.shear_ratio > 0 && std::isfinite(p.shear_ratio), "Shear ratio", p.shear_ratio,
              "must be above 0: without shear stiffness a particle spins freely.");
    }

    Physics physics_of(const NetworkParameters &p)
    {
      Physics physics;
      physics.dimension = p.dimension;
      physics.rotations = p.rotations;
      return physics;
    }

    /** In the plane nothing repeats along z. */
    Eigen::Matrix3d effective_cell(const Eigen::Matrix3d &cell, const int dimension, const double third_edge)
    {
      if (dimension == 3)
        return cell;
      Eigen::Matrix3d H       = Eigen::Matrix3d::Zero();
      H.topLeftCorner<2, 2>() = cell.topLeftCorner<2, 2>();
      H(2, 2)                 = third_edge;
      return H;
    }

    /** Stiffness by the moduli of the law. */
    void put_stiffness(ElasticLink &link, const LinkStiffnesses &moduli)
    {
      const double          per_strain = link.area / link.reference;
      const Eigen::Matrix3d nn         = link.direction * link.direction.transpose();
      const Eigen::Matrix3d across     = Eigen::Matrix3d::Identity() - nn;
      link.stiffness                   = per_strain * (moduli.normal * nn + moduli.shear * across);
      link.turning                     = moduli.twist * nn + moduli.bending * across;
    }

    ElasticLink make_link(const CellPacking       &packing,
                          const NeighbourPair     &pair,
                          const Eigen::Matrix3d   &H,
                          const NetworkParameters &p)
    {
      const std::size_t J = pair.first, K = pair.second;
      const double      r_J = packing.radius[J], r_K = packing.radius[K];

      ElasticLink link;
      link.first  = pair.first;
      link.second = pair.second;
      link.shift.setZero();
      for (int c = 0; c < 3; ++c)
        if (pair.shift[c] != 0) // the third edge may be infinite
          link.shift += double(pair.shift[c]) * H.col(c);
      link.branch         = packing.centre[K] + link.shift - packing.centre[J];
      const double length = link.branch.norm();
      link.direction      = link.branch / length;
      link.arm_first      = 0.5 * (length + r_J - r_K);
      link.arm_second     = 0.5 * (length - r_J + r_K);

      ParticleShape shape;
      shape.dimension         = p.dimension;
      shape.thickness         = p.thickness;
      link.area               = shape.link_area(r_J, r_K);
      link.reference          = length;
      link.made.distance      = length;
      link.made.first_radius  = r_J;
      link.made.second_radius = r_K;
      link.made.area          = link.area;
      link.made.thickness     = p.dimension == 2 ? p.thickness : 0.0;
      link.made.first_number  = pair.first;
      link.made.second_number = pair.second;
      link.made.direction     = link.direction;
      return link;
    }

    [[noreturn]] void refuse_no_link(const NetworkParameters &p)
    {
      throw base::InputError("Interaction ratio = " + base::number_text(p.interaction_ratio) +
                             ": no two particles are near enough to be linked. Raise it, or take a denser packing.");
    }

    /** @param finish what gives a link of two particles its stiffness */
    template <typename Finish>
    ElasticNetwork link_up(const CellPacking                &packing,
                           const std::vector<NeighbourPair> &pairs,
                           const Eigen::Matrix3d            &H,
                           const NetworkParameters          &p,
                           const Finish                     &finish)
    {
      if (pairs.empty())
        refuse_no_link(p);
      ElasticNetwork network;
      network.dimension = p.dimension;
      network.rotations = p.rotations;
      network.centre    = packing.centre;
      network.links.reserve(pairs.size());
      for (const NeighbourPair &pair : pairs)
        {
          network.links.push_back(make_link(packing, pair, H, p));
          finish(network.links.back());
        }
      return network;
    }

    /** Links that are all alike. */
    auto only_moduli(const NetworkParameters &p)
    {
      return [&p](ElasticLink &link) {
        put_stiffness(link, {p.normal_modulus, p.shear_ratio * p.normal_modulus, 0, 0});
      };
    }

    /** Gives links the stiffness of their law, and distinguishes bonds from contacts that wait. */
    class LinkFinisher
    {
    public:
      LinkFinisher(const NetworkParameters &parameters, const LinkMaterials &materials)
        : p(parameters)
        , bonds(with_exact_shear(materials.bonds_in_space(physics_of(p))))
      {
        if (1 + p.contact_reach > p.interaction_ratio)
          contacts = with_exact_shear(materials.contacts_in_space(physics_of(p)));
      }

      void finish(ElasticLink &link) const
      {
        const double touching = link.made.first_radius + link.made.second_radius;
        link.waits            = contacts && !(link.made.distance < p.interaction_ratio * touching + p.installation_gap);
        link.waits ? wait(link, touching) : join(link);
      }

      /** A link across a joint, whose stiffness has the axes of the joint, not its own (doc/theory/smooth-joint.md, 7). */
      void cut(ElasticLink &link, const double area) const
      {
        link.area = link.made.area        = area;
        const std::vector<double> history = begun(link);
        LinkStep                  still;
        still.geometry  = geometry_of(link);
        still.direction = link.direction;
        link.stiffness  = area / link.reference *
                         bonds->tangent(link.pair, still, history.data(), history.data(), {}).topLeftCorner<3, 3>();
      }

    private:
      /** @return history of the bond */
      std::vector<double> begun(ElasticLink &link) const
      {
        std::vector<double> history(bonds->columns().size(), 0.0);
        bonds->begin(link.pair, link.made, history.data());
        link.reference = bonds->reference_length(link.pair, link.made);
        return history;
      }

      void join(ElasticLink &link) const
      {
        const std::vector<double> history = begun(link);
        put_stiffness(link, bonds->stiffness(link.pair, geometry_of(link), history.data()));
      }

      void wait(ElasticLink &link, const double touching) const
      {
        std::vector<double> history(contacts->columns().size(), 0.0);
        NewLink             touch = link.made;
        touch.distance            = touching;
        contacts->begin(link.pair, touch, history.data());
        link.reference            = contacts->reference_length(link.pair, touch);
        const LinkGeometry closed = {0, link.reference, link.reference, link.area};
        put_stiffness(link, contacts->stiffness(link.pair, closed, history.data()));
        link.once_closed = link.stiffness;
        link.stiffness.setZero();
        link.turning.setZero();
        link.pair += static_cast<std::int32_t>(bonds->pairs());
      }

      const NetworkParameters       &p;
      std::shared_ptr<const LinkLaw> bonds, contacts; ///< the latter where some may wait
    };

    /** Links of a free packing, or one with an upright cell. */
    template <typename Finish>
    ElasticNetwork network_of(const Packing &packing, const NetworkParameters &p, const Finish &finish)
    {
      check_packing(packing, "packing");
      check_in_cell(packing, "packing");
      CellPacking                    general{packing.centre, packing.radius, Eigen::Matrix3d::Zero()};
      std::optional<Eigen::Vector3d> cell = packing.periodic_cell;
      if (cell && p.dimension == 2)
        (*cell)[2] = std::numeric_limits<double>::infinity();
      if (cell)
        general.cell = cell->asDiagonal();
      const double   factor  = std::max(p.interaction_ratio, 1 + p.contact_reach);
      ElasticNetwork network = link_up(
        general, find_pairs(packing.centre, packing.radius, factor, p.installation_gap, cell), general.cell, p, finish);
      if (cell)
        network.volume = (*cell)[0] * (*cell)[1] * (p.dimension == 2 ? p.thickness : (*cell)[2]);
      return network;
    }
  } // namespace

  LinkGeometry geometry_of(const ElasticLink &link)
  {
    const double length = link.branch.norm();
    return {(length - link.reference) / link.reference, length, link.reference, link.area};
  }

  base::Matrix6 undamaged_stiffness(const ElasticLink &link)
  {
    base::Matrix6 all             = base::Matrix6::Zero();
    all.topLeftCorner<3, 3>()     = link.stiffness;
    all.bottomRightCorner<3, 3>() = link.turning;
    return all;
  }

  std::size_t ElasticNetwork::bonds() const
  {
    return static_cast<std::size_t>(
      std::count_if(links.begin(), links.end(), [](const ElasticLink &link) { return !link.waits; }));
  }

  bool ElasticNetwork::moves(const int component) const
  {
    if (component >= 3 && !rotations)
      return false;
    return dimension == 3 || component == 0 || component == 1 || component == 5;
  }

  ElasticNetwork make_network(const Packing &packing, const NetworkParameters &p)
  {
    check(p);
    return network_of(packing, p, only_moduli(p));
  }

  ElasticNetwork make_network(const Packing &packing, const NetworkParameters &p, const LinkMaterials &materials)
  {
    check_links(p);
    check_materials(packing, materials);
    if (materials.joints() > 0 && p.contact_reach > 0)
      throw base::InputError(
        "Joints: contacts that wait are between particles without a joint. Leave one of them out.");
    if (!materials.unbonded_pairs().empty())
      throw base::InputError(
        "Interfaces: materials without bonds between them are for particles in motion; a network in "
        "equilibrium links all that are near.");
    std::vector<std::int32_t> material = packing.material;
    if (materials.several())
      material.resize(packing.size(), 0);
    const LinkFinisher finisher(p, materials);
    ElasticNetwork     network = network_of(packing, p, [&](ElasticLink &link) {
      if (const JointCut *cut = cut_between(packing.cuts, link.first, link.second))
        {
          link.pair = materials.material_pairs() + cut->joint;
          return finisher.cut(link, cut->area);
        }
      if (materials.several())
        link.pair = material_pair(material[link.first], material[link.second]);
      finisher.finish(link);
    });
    if (network.bonds() == 0)
      refuse_no_link(p);
    if (materials.several())
      network.material = material;
    return network;
  }

  ElasticNetwork make_network(const CellPacking &packing, const NetworkParameters &p)
  {
    check(p);
    check_packing({packing.centre, packing.radius, std::nullopt}, "packing");
    // Far enough along z that no image of the plane comes near.
    const double          largest     = *std::max_element(packing.radius.begin(), packing.radius.end());
    const Eigen::Matrix3d H           = effective_cell(packing.cell, p.dimension, 8 * p.interaction_ratio * largest);
    const double          determinant = H.determinant();
    require(determinant > 0 && std::isfinite(determinant), "Periodic cell", determinant, "its volume must be above 0.");
    ElasticNetwork network = link_up(
      packing, find_pairs_sheared(packing.centre, packing.radius, p.interaction_ratio, 0.0, H), H, p, only_moduli(p));
    network.volume = p.dimension == 3 ? determinant : H.topLeftCorner<2, 2>().determinant() * p.thickness;
    return network;
  }
} // namespace dem
