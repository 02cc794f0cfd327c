#include "apps/text/expression.h"

#include "apps/text/time_table.h"
#include "base/errors.h"

#include <fmt/format.h>

#include <muParser.h>

#include <cmath>

namespace apps
{
  struct Expression::Parser
  {
    explicit Parser(const std::string &text)
    {
      formula.DefineVar("x", &x);
      formula.DefineVar("y", &y);
      formula.DefineVar("z", &z);
      formula.DefineVar("t", &t);
      formula.DefineConst("pi", 3.14159265358979323846);
      formula.SetExpr(text);
    }

    /** To be asked once: the formula is read anew after each time. */
    void find_variables()
    {
      const auto used = formula.GetUsedVar();
      in_time         = used.count("t") > 0;
      in_space        = used.count("x") + used.count("y") + used.count("z") > 0;
    }

    mu::Parser  formula;
    double      x = 0.1, y = 0.2, z = 0.3, t = 0.4;
    bool        in_time = false, in_space = false; ///< what occurs in it, once that has been found
    std::string name;
  };

  Expression::Expression(const std::string &text, const std::string &name)
    : parser(std::make_shared<Parser>(text))
  {
    parser->name = name + " = " + text;
    parser->find_variables();
  }

  Expression::Expression(std::shared_ptr<const TimeTable> by_time)
    : table(std::move(by_time))
  {
  }

  namespace
  {
    /** An equals sign that compares nothing: the formula's language would take it for an assignment, and change x, y, z or t. */
    bool assigns(const std::string &text)
    {
      for (std::size_t i = 0; i < text.size(); ++i)
        {
          if (text[i] != '=')
            continue;
          const bool first_of_two = i + 1 < text.size() && text[i + 1] == '=';
          const bool compares     = i > 0 && std::string("=<>!").find(text[i - 1]) != std::string::npos;
          if (!first_of_two && !compares)
            return true;
        }
      return false;
    }
  } // namespace

  std::string Expression::fault(const std::string &text)
  {
    if (assigns(text))
      return "\"=\" assigns; give the right-hand side only, or compare with \"==\"";
    try
      {
        Parser parser(text);
        int    values = 0;
        parser.formula.Eval(values); // read at the first evaluation; a value that is no number is the caller's matter
        if (values > 1)
          return fmt::format("it has {} values, separated by commas; a decimal point is \".\"", values);
        return "";
      }
    catch (const mu::ParserError &error)
      {
        return error.GetMsg();
      }
  }

  bool Expression::varies_in_time() const { return table != nullptr || (parser != nullptr && parser->in_time); }

  bool Expression::varies_in_space() const { return parser != nullptr && parser->in_space; }

  double Expression::operator()(const double x, const double y, const double z, const double t) const
  {
    if (table != nullptr)
      return (*table)(t);
    parser->x          = x;
    parser->y          = y;
    parser->z          = z;
    parser->t          = t;
    const double value = parser->formula.Eval();
    if (!std::isfinite(value))
      throw base::NumericalError(
        fmt::format("{}: is {} at x = {}, y = {}, z = {}, t = {}.", parser->name, value, x, y, z, t));
    return value;
  }
} // namespace apps
