#include "apps/statistics/polynomial.h"

#include "base/errors.h"

#include <algorithm>
#include <utility>

namespace statistics
{
  namespace
  {
    using Powers = Polynomial::Powers;

    std::vector<Powers> up_to_linear(const std::size_t factors)
    {
      std::vector<Powers> terms = {Powers(factors, 0)};
      for (std::size_t factor = 0; factor < factors; ++factor)
        {
          terms.emplace_back(factors, 0);
          terms.back()[factor] = 1;
        }
      return terms;
    }

    /** "A^2" as factor and exponent, from 1 to 9. */
    std::pair<std::size_t, int>
    factor_and_exponent(const std::string &part, const std::vector<std::string> &factors, const std::string &term)
    {
      const std::size_t length = part.size();
      const bool raised = length > 2 && part[length - 2] == '^' && part[length - 1] >= '1' && part[length - 1] <= '9';
      const auto found  = std::find(factors.begin(), factors.end(), raised ? part.substr(0, length - 2) : part);
      if (found == factors.end())
        throw base::InputError("the term \"" + term + "\" is not made of powers, from 1 to 9, of the factors.");
      return {found - factors.begin(), raised ? part[length - 1] - '0' : 1};
    }

    Powers powers_of(const std::string &term, const std::vector<std::string> &factors)
    {
      Powers powers(factors.size(), 0);
      if (term == "1")
        return powers;
      for (std::size_t begin = 0; begin <= term.size();)
        {
          const std::size_t star        = std::min(term.find('*', begin), term.size());
          const auto [factor, exponent] = factor_and_exponent(term.substr(begin, star - begin), factors, term);
          powers[factor] += exponent;
          begin = star + 1;
        }
      return powers;
    }

    double power(const double base, const int exponent)
    {
      double product = 1;
      for (int k = 0; k < exponent; ++k)
        product *= base;
      return product;
    }

    double binomial(const int n, const int k)
    {
      double value = 1;
      for (int i = 1; i <= k; ++i)
        value = value * (n - k + i) / i;
      return value;
    }

    /** Of the coded term, what stands before the physical term: 0 where that has a higher power. */
    double share(const Powers &physical, const Powers &coded, const Box &box)
    {
      double product = 1;
      for (std::size_t factor = 0; factor < coded.size(); ++factor)
        {
          const int n = coded[factor], k = physical[factor];
          if (k > n)
            return 0;
          const double half = box.half()[factor], centre = box.centre()[factor];
          product *= binomial(n, k) * power(1 / half, k) * power(-centre / half, n - k);
        }
      return product;
    }
  } // namespace

  bool Box::contains(const Eigen::VectorXd &point) const
  {
    return (point.array() >= lower.array()).all() && (point.array() <= upper.array()).all();
  }

  Polynomial::Polynomial(std::vector<std::string> factors, std::vector<Powers> terms_)
    : factor_names(std::move(factors))
    , terms(std::move(terms_))
  {
  }

  Polynomial Polynomial::linear(const std::vector<std::string> &factors)
  {
    return {factors, up_to_linear(factors.size())};
  }

  Polynomial Polynomial::quadratic(const std::vector<std::string> &factors)
  {
    std::vector<Powers> terms = up_to_linear(factors.size());
    for (std::size_t factor = 0; factor < factors.size(); ++factor)
      {
        terms.emplace_back(factors.size(), 0);
        terms.back()[factor] = 2;
      }
    for (std::size_t first = 0; first < factors.size(); ++first)
      for (std::size_t second = first + 1; second < factors.size(); ++second)
        {
          terms.emplace_back(factors.size(), 0);
          terms.back()[first] = terms.back()[second] = 1;
        }
    return {factors, terms};
  }

  Polynomial Polynomial::of_terms(const std::vector<std::string> &factors, const std::vector<std::string> &names)
  {
    std::vector<Powers> terms;
    for (const std::string &name : names)
      terms.push_back(powers_of(name, factors));
    return {factors, terms};
  }

  std::vector<std::string> Polynomial::term_names() const
  {
    std::vector<std::string> names;
    for (const Powers &term : terms)
      {
        std::string name;
        for (std::size_t factor = 0; factor < term.size(); ++factor)
          if (term[factor] > 0)
            name += (name.empty() ? "" : "*") + factor_names[factor] +
                    (term[factor] > 1 ? "^" + std::to_string(term[factor]) : "");
        names.push_back(name.empty() ? "1" : name);
      }
    return names;
  }

  Eigen::VectorXd Polynomial::at(const Eigen::VectorXd &point) const
  {
    Eigen::VectorXd values = Eigen::VectorXd::Ones(terms.size());
    for (std::size_t term = 0; term < terms.size(); ++term)
      for (std::size_t factor = 0; factor < terms[term].size(); ++factor)
        values[term] *= power(point[factor], terms[term][factor]);
    return values;
  }

  Eigen::MatrixXd Polynomial::matrix(const Eigen::MatrixXd &points) const
  {
    Eigen::MatrixXd all(points.rows(), terms.size());
    for (Eigen::Index run = 0; run < points.rows(); ++run)
      all.row(run) = at(points.row(run).transpose()).transpose();
    return all;
  }

  Eigen::MatrixXd Polynomial::derivatives(const Eigen::VectorXd &point) const
  {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(terms.size(), point.size());
    for (std::size_t term = 0; term < terms.size(); ++term)
      for (std::size_t by = 0; by < terms[term].size(); ++by)
        {
          if (terms[term][by] == 0)
            continue;
          double product = terms[term][by];
          for (std::size_t factor = 0; factor < terms[term].size(); ++factor)
            product *= power(point[factor], terms[term][factor] - (factor == by ? 1 : 0));
          all(term, by) = product;
        }
    return all;
  }

  Eigen::MatrixXd Polynomial::decoding(const Box &box) const
  {
    Eigen::MatrixXd matrix(terms.size(), terms.size());
    for (std::size_t physical = 0; physical < terms.size(); ++physical)
      for (std::size_t coded = 0; coded < terms.size(); ++coded)
        matrix(physical, coded) = share(terms[physical], terms[coded], box);
    return matrix;
  }
} // namespace statistics
