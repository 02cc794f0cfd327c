#pragma once

#include "dem/network/loaded_network.h"
#include "dem/network/slip_matrices.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cstdint>
#include <vector>

namespace dem
{
  /** Of all links, as they are undamaged. */
  std::vector<base::Matrix6> undamaged_stiffnesses(const LoadedNetwork &loaded);

  /** The stiffness of a network's links on the unknown motions of its particles, as a sparse matrix whose pattern stays. */
  class TangentMatrix
  {
  public:
    using Sparse = Eigen::SparseMatrix<double>;

    /**
     * @param loaded, unknown, first must outlive this object
     * @param unknown of each motion of each particle its number, -1 where held @param first of each particle, and the end
     * @param scale that makes lengths of rotations [m]
     * @param kept part of the undamaged diagonal that is added to the diagonal
     */
    TangentMatrix(const LoadedNetwork    &loaded,
                  const std::vector<int> &unknown,
                  const std::vector<int> &first,
                  double                  scale,
                  double                  kept);

    /** @param stiffness of each link */
    void          assemble(const std::vector<base::Matrix6> &stiffness);
    const Sparse &whole() const { return matrix; }
    /** Of the undamaged stiffness; where a motion meets none, the mean. */
    const Eigen::VectorXd &undamaged_diagonal() const { return diagonal; }

  private:
    /** Where the four blocks of a link begin in the columns of its ends. */
    struct BlockPlaces
    {
      int JJ, JK, KJ, KK; ///< XY: rows of X in the columns of Y
    };

    void lay_out();
    void add(std::int32_t rows, std::int32_t columns, int place, const Block &block);

    const LoadedNetwork     &loaded;
    const std::vector<int>  &unknown, &first;
    int                      count;
    double                   scale, kept;
    Sparse                   matrix;
    std::vector<BlockPlaces> places;
    Eigen::VectorXd          diagonal;
  };
} // namespace dem
