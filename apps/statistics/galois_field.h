#pragma once

#include <vector>

namespace statistics
{
  /**
   * A field of 2, 3, 4, 5, 7, 8 or 9 elements, the numbers from 0. Their digits to the base of the characteristic are the coefficients
   * of polynomials, which are multiplied modulo an irreducible one (doc/theory/studies.md, 1).
   */
  class GaloisField
  {
  public:
    /** @throws base::InputError for another order */
    explicit GaloisField(int order);

    int order() const { return elements; }
    int add(int a, int b) const { return sums[a * elements + b]; }
    int multiply(int a, int b) const { return products[a * elements + b]; }

  private:
    int              elements;
    std::vector<int> sums, products;
  };
} // namespace statistics
