// Non-linear problems of the Statistical Reference Datasets (National Institute of Standards and Technology): data, starts and
// certified constants with standard errors. The certified sum of squares, to eleven digits, also guards the data as typed here.
#include "apps/optimisation/references.h"

#include "apps/optimisation/bennett5.h"
#include "apps/optimisation/least_squares_search.h"
#include "apps/statistics/uncertainty.h"

#include <cmath>
#include <string>

namespace optimisation
{
  namespace
  {
    using Constants = std::vector<double>;

    struct ReferenceProblem
    {
      std::string            name;
      Constants              x, y;
      std::vector<Constants> starts;
      Constants              certified, standard_errors;
      double                 sum_of_squares;
      double (*model)(const Eigen::VectorXd &b, double x);
    };

    const Constants misra_x = {77.6,  114.9, 141.1, 190.8, 239.9, 289.0, 332.8,
                               378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.0};
    const Constants misra_y = {10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02,
                               44.82, 50.76, 55.05, 61.01, 66.40, 75.47, 81.78};

    std::vector<ReferenceProblem> reference_problems()
    {
      return {
        {"Misra1a",
         misra_x,
         misra_y,
         {{500, 1e-4}, {250, 5e-4}},
         {2.3894212918e2, 5.5015643181e-4},
         {2.7070075241, 7.2668688436e-6},
         1.2455138894e-1,
         [](const Eigen::VectorXd &b, double x) { return b[0] * (1 - std::exp(-b[1] * x)); }},
        {"Misra1b",
         misra_x,
         misra_y,
         {{500, 1e-4}, {300, 2e-4}},
         {3.3799746163e2, 3.9039091287e-4},
         {3.1643950207, 4.2547321834e-6},
         7.5464681533e-2,
         [](const Eigen::VectorXd &b, double x) { return b[0] * (1 - std::pow(1 + b[1] * x / 2, -2)); }},
        {"Misra1c",
         misra_x,
         misra_y,
         {{500, 1e-4}, {600, 2e-4}},
         {6.3642725809e2, 2.0813627256e-4},
         {4.6638326572, 1.7728423155e-6},
         4.0966836971e-2,
         [](const Eigen::VectorXd &b, double x) { return b[0] * (1 - 1 / std::sqrt(1 + 2 * b[1] * x)); }},
        {"Misra1d",
         misra_x,
         misra_y,
         {{500, 1e-4}, {450, 3e-4}},
         {4.3736970754e2, 3.0227324449e-4},
         {3.6489174345, 2.9334354479e-6},
         5.6419295283e-2,
         [](const Eigen::VectorXd &b, double x) { return b[0] * b[1] * x / (1 + b[1] * x); }},
        {"BoxBOD",
         {1, 2, 3, 5, 7, 10},
         {109, 149, 149, 191, 213, 224},
         {{1, 1}, {100, 0.75}},
         {2.1380940889e2, 5.4723748542e-1},
         {1.2354515176e1, 1.0455993237e-1},
         1.1680088766e3,
         [](const Eigen::VectorXd &b, double x) { return b[0] * (1 - std::exp(-b[1] * x)); }},
        {"DanWood",
         {1.309, 1.471, 1.490, 1.565, 1.611, 1.680},
         {2.138, 3.421, 3.597, 4.340, 4.882, 5.660},
         {{1, 5}, {0.7, 4}},
         {7.6886226176e-1, 3.8604055871},
         {1.8281973860e-2, 5.1726610913e-2},
         4.3173084083e-3,
         [](const Eigen::VectorXd &b, double x) { return b[0] * std::pow(x, b[1]); }},
        {"MGH09",
         {4, 2, 1, 0.5, 0.25, 0.167, 0.125, 0.1, 0.0833, 0.0714, 0.0625},
         {0.1957, 0.1947, 0.1735, 0.16, 0.0844, 0.0627, 0.0456, 0.0342, 0.0323, 0.0235, 0.0246},
         {{25, 39, 41.5, 39}, {0.25, 0.39, 0.415, 0.39}},
         {1.9280693458e-1, 1.9128232873e-1, 1.2305650693e-1, 1.3606233068e-1},
         {1.1435312227e-2, 1.9633220911e-1, 8.0842031232e-2, 9.0025542308e-2},
         3.0750560385e-4,
         [](const Eigen::VectorXd &b, double x) { return b[0] * (x * x + x * b[1]) / (x * x + x * b[2] + b[3]); }},
        {"MGH10",
         {50, 55, 60, 65, 70, 75, 80, 85, 90, 95, 100, 105, 110, 115, 120, 125},
         {34780, 28610, 23650, 19630, 16370, 13720, 11540, 9744, 8261, 7030, 6005, 5147, 4427, 3820, 3307, 2872},
         {{2, 4e5, 2.5e4}, {0.02, 4000, 250}},
         {5.6096364710e-3, 6.1813463463e3, 3.4522363462e2},
         {1.5687892471e-4, 2.3309021107e1, 7.8486103508e-1},
         8.7945855171e1,
         [](const Eigen::VectorXd &b, double x) { return b[0] * std::exp(b[1] / (x + b[2])); }},
        {"Thurber",
         {-3.067, -2.981, -2.921, -2.912, -2.840, -2.797, -2.702, -2.699, -2.633, -2.481, -2.363, -2.322, -1.501,
          -1.460, -1.274, -1.212, -1.100, -1.046, -0.915, -0.714, -0.566, -0.545, -0.400, -0.309, -0.109, -0.103,
          0.010,  0.119,  0.377,  0.790,  0.963,  1.006,  1.115,  1.572,  1.841,  2.047,  2.200},
         {80.574,   84.248,   87.264,   87.195,   89.076,   89.608,   89.868,   90.101,   92.405,   95.854,
          100.696,  101.060,  401.672,  390.724,  567.534,  635.316,  733.054,  759.087,  894.206,  990.785,
          1090.109, 1080.914, 1122.643, 1178.351, 1260.531, 1273.514, 1288.339, 1327.543, 1353.863, 1414.509,
          1425.208, 1421.384, 1442.962, 1464.350, 1468.705, 1447.894, 1457.628},
         {{1000, 1000, 400, 40, 0.7, 0.3, 0.03}, {1300, 1500, 500, 75, 1, 0.4, 0.05}},
         {1.2881396800e3, 1.4910792535e3, 5.8323836877e2, 7.5416644291e1, 9.6629502864e-1, 3.9797285797e-1,
          4.9727297349e-2},
         {4.6647963344, 3.9571156086e1, 2.8698696102e1, 5.5675370270, 3.1333340687e-2, 1.4984928198e-2,
          6.5842344623e-3},
         5.6427082397e3,
         [](const Eigen::VectorXd &b, double x) {
           return (b[0] + x * (b[1] + x * (b[2] + x * b[3]))) / (1 + x * (b[4] + x * (b[5] + x * b[6])));
         }},
        {"Bennett5",
         bennett5_x,
         bennett5_y,
         {{-2000, 50, 0.8}, {-1500, 45, 0.85}},
         {-2.5235058043e3, 4.6736564644e1, 9.3218483193e-1},
         {2.9715175411e2, 1.2448871856, 2.0272299378e-2},
         5.2404744073e-4,
         [](const Eigen::VectorXd &b, double x) { return b[0] * std::pow(b[1] + x, -1 / b[2]); }}};
    }

    Eigen::VectorXd vector_of(const Constants &values)
    {
      return Eigen::Map<const Eigen::VectorXd>(values.data(), values.size());
    }

    Eigen::VectorXd residuals_of(const ReferenceProblem &reference, const Eigen::VectorXd &b)
    {
      Eigen::VectorXd residuals(reference.x.size());
      for (std::size_t k = 0; k < reference.x.size(); ++k)
        residuals[k] = reference.model(b, reference.x[k]) - reference.y[k];
      return residuals;
    }

    LeastSquaresFit fitted(const ReferenceProblem &reference, const Eigen::VectorXd &start)
    {
      const Eigen::VectorXd infinite = Eigen::VectorXd::Constant(start.size(), INFINITY);
      LeastSquaresOptions   options;
      options.central_differences = true;
      options.most_evaluations    = 100000;
      options.smallest_decrease   = 1e-15;
      const auto residuals        = [&reference](const std::vector<Eigen::VectorXd> &places) {
        std::vector<std::optional<Eigen::VectorXd>> all;
        for (const Eigen::VectorXd &b : places)
          all.push_back(residuals_of(reference, b));
        return all;
      };
      return least_squares({start, -infinite, infinite, 1e-5 * start.cwiseAbs(), residuals}, options);
    }

    /** Of the fits from both starts the value that errs more. */
    double worse(const std::vector<double> &found, const double certified)
    {
      double worst = found.front();
      for (const double value : found)
        if (!(std::fabs(value - certified) <= std::fabs(worst - certified)))
          worst = value;
      return worst;
    }

    void certified_constants(base::Comparisons &rows)
    {
      for (const ReferenceProblem &problem : reference_problems())
        {
          const Eigen::VectorXd            certified = vector_of(problem.certified);
          std::vector<double>              sums;
          std::vector<std::vector<double>> constants(problem.certified.size()), errors(problem.certified.size());
          for (const Constants &start : problem.starts)
            {
              LeastSquaresFit fit = fitted(problem, vector_of(start));
              fit = fitted(problem, fit.place); // once more, with differences as wide as the answer asks for
              const statistics::Uncertainty sure =
                statistics::uncertainty(fit.jacobian, fit.residuals, fit.place.cwiseAbs(), {{}, 0, 1e14});
              sums.push_back(fit.sum_of_squares());
              for (std::size_t k = 0; k < constants.size(); ++k)
                {
                  constants[k].push_back(fit.place[static_cast<Eigen::Index>(k)]);
                  errors[k].push_back(sure.standard_errors[static_cast<Eigen::Index>(k)]);
                }
            }
          rows.of(problem.name + ": sum of squares as typed", "", residuals_of(problem, certified).squaredNorm())
            .within(1e-9, problem.sum_of_squares);
          rows.of(problem.name + ": sum of squares", "", worse(sums, problem.sum_of_squares))
            .within(1e-9, problem.sum_of_squares);
          for (std::size_t k = 0; k < constants.size(); ++k)
            {
              const std::string name = problem.name + ": b" + std::to_string(k + 1);
              rows.of(name, "", worse(constants[k], problem.certified[k])).within(1e-6, problem.certified[k]);
              rows.of(name + ", standard error", "", worse(errors[k], problem.standard_errors[k]))
                .within(1e-6, problem.standard_errors[k]);
            }
        }
    }
  } // namespace

  const std::vector<base::Reference> &all_references()
  {
    static const std::vector<base::Reference> all = {
      {"least squares: non-linear problems from two starts",
       "Statistical Reference Datasets, National Institute of Standards and Technology", certified_constants}};
    return all;
  }
} // namespace optimisation
