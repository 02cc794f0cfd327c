#pragma once

#include "base/state.h"
#include "coupling/contact/bodies/body_contact_parameters.h"
#include "coupling/contact/bodies/near_simplices.h"
#include "coupling/contact/bodies/overlap_force.h"

#include <map>
#include <optional>

namespace coupling::bodies
{
  /** What the contacts hold and have turned into heat [J]. */
  struct BodyContactEnergy
  {
    double normal     = 0; ///< stored by overlaps; of the penalty form an estimate, k_v V^2/2 over the area
    double shear      = 0; ///< stored by friction that holds
    double dissipated = 0; ///< by friction that slides
  };

  /** Where bodies touch now. */
  struct ContactPatch
  {
    double area = 0; ///< of all places [m^2]
    double face = 0; ///< of an element that touches, in the mean [m^2]
  };

  /**
   * Contact between deformable bodies, found from their overlaps (doc/theory/body-contact.md): normal forces by overlap_force(), and
   * Coulomb friction with a spring for each element of one body on another body, which remembers where it held.
   * Same bits for any number of threads.
   */
  class BodyContacts
  {
  public:
    /** @throws base::InputError for parameters out of range */
    BodyContacts(BodyMesh mesh, const BodyContactParameters &parameters);

    const BodyMesh &mesh() const { return bodies; }

    /**
     * All vertices are here now; find the forces. Springs of friction follow the motion since the last call: once per step.
     * @throws base::NumericalError where one body reaches deeper into another than the layer that was meshed
     */
    void move_to(const std::vector<Eigen::Vector3d> &place);

    const std::vector<Eigen::Vector3d> &force() const { return forces; } ///< on the vertices [N]
    const std::vector<double>          &stiffness() const
    {
      return stiffnesses;
    } ///< of the contacts at each vertex, row sums [N/m]
    const std::vector<Eigen::Vector3d> &on_body() const { return resultants; } ///< forces on each body [N]
    BodyContactEnergy                   energy() const { return account; }
    double                              overlap() const { return volume; } ///< of all [m^3]
    std::size_t                         touching() const { return met; }   ///< pairs of bodies
    ContactPatch                        patch() const;

    /** A reader must hold the same mesh. @param group before all names */
    void visit_state(base::StateVisitor &visitor, const std::string &group);

  private:
    /** An element on a body. */
    struct Holder
    {
      std::int32_t element, body;

      bool operator<(const Holder &o) const { return element != o.element ? element < o.element : body < o.body; }
    };
    /** Friction of a holder. */
    struct Spring
    {
      Eigen::Vector3d stretch = Eigen::Vector3d::Zero(); ///< of the element against the body [m]
      Eigen::Vector3d normal  = Eigen::Vector3d::Zero(); ///< of the contact, from the element
    };
    using Pair = std::pair<NearSimplices, OverlapForce>;

    void find_pairs();
    void push();
    void estimate_penalty_energy();
    void rub();
    /** @param old spring of this holder, if it had one. @return the new one; none where nothing presses */
    std::optional<Spring> rub(const Holder &of, std::size_t begin, std::size_t end, const Spring *old);
    Holder                holder_of(const Pair &pair) const;
    double                shear_stiffness(const Holder &of) const; ///< [N/m]
    /** Of the first simplex against the second where they overlap, since the last call [m]. */
    Eigen::Vector3d relative_motion(const Pair &pair) const;
    void            share(const Pair &pair, const Eigen::Vector3d &on_first);
    void            stiffen(const Pair &pair, double by);

    BodyMesh                     bodies;
    BodyContactParameters        law;
    NearBodies                   near;
    std::vector<Eigen::Vector3d> before, forces, resultants;
    std::vector<double>          stiffnesses;
    std::vector<Pair>            touched; ///< pairs that overlap, by element of the first and body of the second
    std::map<Holder, Spring>     springs;
    BodyContactEnergy            account;
    double                       volume = 0;
    std::size_t                  met    = 0;
  };
} // namespace coupling::bodies
