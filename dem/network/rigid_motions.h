#pragma once

#include "dem/network/elastic_network.h"
#include "dem/network/mechanisms.h"
#include "dem/network/stiffness_operator.h"

#include <Eigen/Core>

#include <vector>

namespace dem
{
  /** Of each particle: displacement and rotation, or force and moment. */
  using ParticleMotions = Eigen::Matrix<double, motions, Eigen::Dynamic>;

  /** As many rows as the matrix has columns: no combination of its columns vanishes in all of them. They are where it is largest. */
  std::vector<Eigen::Index> rows_to_hold(Eigen::MatrixXd free);

  /**
   * Motions of whole bodies (particles joined by links) that what is held does not prevent: specimens between grips that hold them
   * along their axis only may still move sideways. A static solution exists if no load acts along them, and is made unique by
   * supports that carry nothing; of all solutions, the one without any such motion is that which depends on no choice of supports.
   */
  class RigidMotions
  {
  public:
    /**
     * @param held  of each particle
     * @param weak  particles that cannot support the others, such as those on hinges
     */
    RigidMotions(const ElasticNetwork            &network,
                 const std::vector<HeldMotions>  &held,
                 const std::vector<std::int32_t> &weak = {});

    /** Bodies of which nothing is held at all. */
    const std::vector<Mechanism> &floating() const { return unheld; }
    /** How many independent motions are free, of the bodies that something holds. */
    std::size_t count() const { return fields.size(); }
    /** Largest share of a load [N, N m] that acts along a free motion, in [0, 1]. */
    double loaded_by(const ParticleMotions &load) const;
    /** What is held, and supports for the free motions. */
    const std::vector<HeldMotions> &supported() const { return supports; }
    /** Take them out of small motions [m, -]. */
    void remove_from(ParticleMotions &motion) const;

  private:
    struct Field
    {
      std::vector<std::int32_t> particles;
      ParticleMotions motion; ///< of each of them, rotations as lengths; orthonormal to the others of the body
    };

    void                     add_body(const ElasticNetwork &network, const std::vector<std::int32_t> &members);
    double                   scale; ///< of rotations [m]
    std::vector<HeldMotions> held, supports;
    std::vector<char>        is_weak;
    std::vector<Field>       fields;
    std::vector<Mechanism>   unheld;
  };
} // namespace dem
