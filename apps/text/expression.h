#pragma once

#include <memory>
#include <string>

namespace apps
{
  class TimeTable;

  /** A formula of place [m] and time [s], as a scene writes it, e.g. "-1e-3*t*(1 - x/0.2)"; or a table by time. */
  class Expression
  {
  public:
    /** Not given. */
    Expression() = default;

    /**
     * @param text in x, y, z, t and pi, with the operators and functions of muParser: + - * / ^, sin, exp, min,
     *   a < b ? c : d, ...
     * @param name for messages: where the formula stands.
     */
    Expression(const std::string &text, const std::string &name);

    /** By time alone. */
    explicit Expression(std::shared_ptr<const TimeTable> by_time);

    /** What is wrong with a formula, "" if nothing. */
    static std::string fault(const std::string &text);

    bool given() const { return parser != nullptr || table != nullptr; }

    /** Whether t occurs in it; a formula that is not given does not vary. */
    bool varies_in_time() const;

    /** Whether a place, x, y or z, occurs in it. */
    bool varies_in_space() const;

    /** @throws base::NumericalError naming the formula and the place if the value is not a finite number. */
    double operator()(double x, double y, double z, double t) const;

  private:
    struct Parser;
    std::shared_ptr<Parser>          parser; // copies of an expression share it
    std::shared_ptr<const TimeTable> table;
  };
} // namespace apps
