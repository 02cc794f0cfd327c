#include "apps/statistics/galois_field.h"

#include "base/errors.h"

#include <string>

namespace statistics
{
  namespace
  {
    struct Extension
    {
      int              characteristic;
      std::vector<int> rule; ///< the highest power, by lower ones: x^n = rule[0] + rule[1] x + ...
    };

    Extension extension_of(const int order)
    {
      switch (order)
        {
        case 2:
        case 3:
        case 5:
        case 7:
          return {order, {0}};
        case 4:
          return {2, {1, 1}}; // x^2 = x + 1
        case 8:
          return {2, {1, 1, 0}}; // x^3 = x + 1
        case 9:
          return {3, {1, 1}}; // x^2 = x + 1
        default:
          throw base::InputError("orthogonal array: " + std::to_string(order) +
                                 " levels. There are fields of 2, 3, 4, 5, 7, 8 and 9 elements.");
        }
    }

    std::vector<int> digits_of(int number, const Extension &field)
    {
      std::vector<int> digits(field.rule.size());
      for (int &digit : digits)
        {
          digit = number % field.characteristic;
          number /= field.characteristic;
        }
      return digits;
    }

    int number_of(const std::vector<int> &digits, const int base)
    {
      int number = 0;
      for (auto digit = digits.rbegin(); digit != digits.rend(); ++digit)
        number = number * base + *digit;
      return number;
    }

    int sum(const int a, const int b, const Extension &field)
    {
      std::vector<int>       digits = digits_of(a, field);
      const std::vector<int> others = digits_of(b, field);
      for (std::size_t i = 0; i < digits.size(); ++i)
        digits[i] = (digits[i] + others[i]) % field.characteristic;
      return number_of(digits, field.characteristic);
    }

    int product(const int a, const int b, const Extension &field)
    {
      const std::size_t      n     = field.rule.size();
      const std::vector<int> left  = digits_of(a, field);
      const std::vector<int> right = digits_of(b, field);
      std::vector<int>       powers(2 * n - 1, 0);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
          powers[i + j] += left[i] * right[j];
      for (std::size_t high = powers.size(); high-- > n;)
        for (std::size_t low = 0; low < n; ++low)
          powers[high - n + low] += powers[high] * field.rule[low];
      powers.resize(n);
      for (int &power : powers)
        power %= field.characteristic;
      return number_of(powers, field.characteristic);
    }
  } // namespace

  GaloisField::GaloisField(const int order)
    : elements(order)
  {
    const Extension field = extension_of(order);
    for (int a = 0; a < order; ++a)
      for (int b = 0; b < order; ++b)
        {
          sums.push_back(sum(a, b, field));
          products.push_back(product(a, b, field));
        }
  }
} // namespace statistics
