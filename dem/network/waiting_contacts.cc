#include "dem/network/waiting_contacts.h"

#include "dem/kernels/first_order_shear.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace dem
{
  namespace
  {
    /** A contact remembers what its law does, the same of a contact that is new, and how far apart it was. */
    class BondsAndWaitingContacts : public LinkLaw
    {
    public:
      BondsAndWaitingContacts(std::shared_ptr<const LinkLaw> bonds_, std::shared_ptr<const LinkLaw> contacts_)
        : LinkLaw(traits_of(*bonds_, *contacts_))
        , bond(std::move(bonds_))
        , contact(std::move(contacts_))
        , fresh(contact->columns().size())
        , gap(2 * fresh)
      {
        if (contact->pairs() != bond->pairs())
          throw std::invalid_argument("waiting contacts: bonds and contacts are of different materials.");
      }

      LinkPass pass(Mixture) const override { only_statics(); }
      double   reference_length(std::size_t, const NewLink &) const override { only_statics(); }

      std::vector<LinkQuantity> columns() const override
      {
        std::vector<LinkQuantity> all = bond->columns();
        for (std::size_t k = all.size(); k <= gap; ++k)
          all.push_back({"of_contact_" + std::to_string(k), "-", "history of a contact that waits"});
        return all;
      }

      void begin(const std::size_t pair, const NewLink &link, double *history) const override
      {
        if (is_bond(pair))
          return bond->begin(pair, link, history);
        contact->begin(of(pair), at_touch(link), history);
        std::copy_n(history, fresh, history + fresh);
        history[gap] = link.distance / at_touch(link).distance - 1;
      }

      LinkStiffnesses stiffness(const std::size_t pair, const LinkGeometry &link, const double *history) const override
      {
        if (is_bond(pair))
          return bond->stiffness(pair, link, history);
        return touches(link) ? contact->stiffness(of(pair), link, history) : LinkStiffnesses();
      }

      LinkStiffnesses
      damaged_stiffness(const std::size_t pair, const LinkGeometry &link, const double *history) const override
      {
        if (is_bond(pair))
          return bond->damaged_stiffness(pair, link, history);
        return touches(link) ? contact->damaged_stiffness(of(pair), link, history) : LinkStiffnesses();
      }

      LinkPhase phase(const std::size_t pair, const LinkGeometry &link, const double *history) const override
      {
        if (is_bond(pair))
          return bond->phase(pair, link, history);
        return touches(link) ? contact->phase(of(pair), link, history) : LinkPhase::apart;
      }

      std::vector<BrokenElement> broken_elements(const std::size_t      pair,
                                                 const LinkGeometry    &link,
                                                 const Eigen::Vector3d &direction,
                                                 const double          *history) const override
      {
        return is_bond(pair) ? bond->broken_elements(pair, link, direction, history) : std::vector<BrokenElement>();
      }

      double stored(const std::size_t pair, const LinkGeometry &link, const double *history) const override
      {
        if (is_bond(pair))
          return bond->stored(pair, link, history);
        return touches(link) ? contact->stored(of(pair), link, history) : 0.0;
      }

      double damage_dissipation(const std::size_t pair, const LinkGeometry &link, const double *history) const override
      {
        if (is_bond(pair))
          return bond->damage_dissipation(pair, link, history);
        return touches(link) ? contact->damage_dissipation(of(pair), link, history) : 0.0;
      }

      LinkLoss damage(const std::size_t pair, const LinkGeometry &link, const double *history) const override
      {
        return is_bond(pair) ? bond->damage(pair, link, history) : LinkLoss();
      }

      double damaging_strain(const std::size_t pair, const double *history) const override
      {
        return is_bond(pair) ? bond->damaging_strain(pair, history) : std::numeric_limits<double>::infinity();
      }

      /** What ends elasticity is that they touch. */
      LinkExertion exertion(const std::size_t      pair,
                            const LinkGeometry    &link,
                            const Eigen::Vector3d &direction,
                            const Eigen::Vector3d &force,
                            const double          *history) const override
      {
        if (is_bond(pair))
          return bond->exertion(pair, link, direction, force, history);
        if (history[gap] > 0)
          return {1 - link.strain / history[gap], 0};
        return {touches(link) ? std::numeric_limits<double>::infinity() : 0.0, 0};
      }

      LinkAnswer
      update(const std::size_t pair, const LinkStep &step, const double *before, double *history) const override
      {
        if (is_bond(pair))
          return bond->update(pair, step, before, history);
        std::copy_n(before + fresh, gap + 1 - fresh, history + fresh);
        if (touches(step.geometry))
          return contact->update(of(pair), since_touch(step), before, history);
        std::copy_n(before + fresh, fresh, history);
        LinkAnswer parted;
        if (step.strain_before < 0) // what its shear had stored goes with it
          parted.friction = contact->stored(of(pair), just_touching(step.geometry), before);
        return parted;
      }

      base::Matrix6 tangent(const std::size_t pair,
                            const LinkStep   &step,
                            const double     *before,
                            const double     *history,
                            const LinkTangent kind) const override
      {
        if (is_bond(pair))
          return bond->tangent(pair, step, before, history, kind);
        if (!touches(step.geometry))
          return base::Matrix6::Zero();
        const base::Matrix6 own = contact->tangent(of(pair), since_touch(step), before, history, kind);
        return kind.secant || step.strain_before <= 0 ? own : base::Matrix6(own * share_of_step(step));
      }

    private:
      [[noreturn]] static void only_statics()
      {
        throw std::logic_error("waiting contacts: a network at small strain has them, and a specimen in motion finds "
                               "its contacts itself.");
      }

      bool        is_bond(const std::size_t pair) const { return pair < bond->pairs(); }
      std::size_t of(const std::size_t pair) const { return pair - bond->pairs(); }

      static bool touches(const LinkGeometry &link) { return link.strain < 0; }

      static NewLink at_touch(NewLink link)
      {
        link.distance = link.first_radius + link.second_radius;
        return link;
      }

      static LinkGeometry just_touching(const LinkGeometry &link)
      {
        return {0, link.reference, link.reference, link.area};
      }

      /** What is left of a step after touching, over the step. */
      static double left_of(const LinkStep &step)
      {
        return step.geometry.strain / (step.geometry.strain - step.strain_before);
      }

      static LinkStep since_touch(LinkStep step)
      {
        if (step.strain_before <= 0)
          return step;
        const double left  = left_of(step);
        step.strain_before = 0;
        step.shear_increment *= left;
        step.bending_increment *= left;
        step.twist_increment *= left;
        return step;
      }

      /** Derivative of what shears and turns a contact that came to touch in the step, by the whole step's. */
      static base::Matrix6 share_of_step(const LinkStep &step)
      {
        const double           left = left_of(step);
        const Eigen::Vector3d &n    = step.direction;
        const Eigen::Matrix3d  nn   = n * n.transpose();
        base::Matrix6          part = left * base::Matrix6::Identity();
        part.topLeftCorner<3, 3>() += (1 - left) * nn;
        const double  opening = step.geometry.strain - step.strain_before;
        base::Vector6 whole;
        whole << step.shear_increment, step.bending_increment + step.twist_increment * n;
        part.leftCols<3>() -= step.strain_before / (opening * opening) * whole * n.transpose();
        return part;
      }

      static LinkLawTraits traits_of(const LinkLaw &bonds, const LinkLaw &contacts)
      {
        LinkLawTraits traits;
        traits.name            = bonds.name();
        traits.pairs           = 2 * bonds.pairs();
        traits.planar          = bonds.planar();
        traits.has_moment      = bonds.has_moment() || contacts.has_moment();
        traits.breaks_in_place = bonds.breaks_in_place();
        traits.bonds           = true;
        return traits;
      }

      std::shared_ptr<const LinkLaw> bond, contact;
      std::size_t                    fresh, gap; ///< where a row has the history of a new contact, and its gap
    };

    Physics physics_of(const ElasticNetwork &network)
    {
      Physics physics;
      physics.dimension = network.dimension;
      physics.rotations = network.rotations;
      return physics;
    }
  } // namespace

  std::shared_ptr<const LinkLaw> with_waiting_contacts(std::shared_ptr<const LinkLaw> bonds,
                                                       std::shared_ptr<const LinkLaw> contacts)
  {
    return std::make_shared<BondsAndWaitingContacts>(std::move(bonds), std::move(contacts));
  }

  std::shared_ptr<const LinkLaw> law_of_links(const ElasticNetwork &network, const LinkMaterials &materials)
  {
    const Physics physics = physics_of(network);
    const auto    bonds   = with_exact_shear(materials.bonds_in_space(physics));
    const bool    waiting =
      std::any_of(network.links.begin(), network.links.end(), [](const ElasticLink &link) { return link.waits; });
    return waiting ? with_waiting_contacts(bonds, with_exact_shear(materials.contacts_in_space(physics))) : bonds;
  }
} // namespace dem
