#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

namespace statistics
{
  /** A box of factors; coded variables go from -1 to 1 in it. */
  struct Box
  {
    Eigen::VectorXd lower, upper;

    Eigen::VectorXd centre() const { return (lower + upper) / 2; }
    Eigen::VectorXd half() const { return (upper - lower) / 2; }
    bool            contains(const Eigen::VectorXd &point) const;
  };

  /** Products of powers of factors: the terms of a response surface. */
  class Polynomial
  {
  public:
    using Powers = std::vector<int>; ///< of each factor

    static Polynomial linear(const std::vector<std::string> &factors);
    /** Constant, linear, squares, products of two: (p + 1)(p + 2) / 2 terms. */
    static Polynomial quadratic(const std::vector<std::string> &factors);

    /**
     * Terms by their names, "1", "A", "A^2", "B*A". @throws base::InputError for one that is not made of the factors
     */
    static Polynomial of_terms(const std::vector<std::string> &factors, const std::vector<std::string> &names);

    const std::vector<std::string> &factors() const { return factor_names; }
    std::size_t                     size() const { return terms.size(); }
    /** "1", "A", "A^2", "A*B". */
    std::vector<std::string> term_names() const;

    /** Value of each term. */
    Eigen::VectorXd at(const Eigen::VectorXd &point) const;
    /** The same for a point in each row. */
    Eigen::MatrixXd matrix(const Eigen::MatrixXd &points) const;
    /** Derivative of each term (rows) by each factor. */
    Eigen::MatrixXd derivatives(const Eigen::VectorXd &point) const;

    /**
     * Coefficients of physical variables are this matrix times those of coded ones, exactly: (x - centre) / half is multiplied out.
     */
    Eigen::MatrixXd decoding(const Box &box) const;

  private:
    Polynomial(std::vector<std::string> factors, std::vector<Powers> terms);

    std::vector<std::string> factor_names;
    std::vector<Powers>      terms;
  };
} // namespace statistics
