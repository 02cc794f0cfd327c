#include "apps/studies/study_file.h"

#include "apps/scene/overrides.h"
#include "apps/scene/parameter_file.h"
#include "apps/scene/reader.h"
#include "apps/text/same_name.h"

#include <algorithm>
#include <filesystem>

namespace apps
{
  namespace
  {
    bool uses_box(const StudyFile &study)
    {
      return study.design == DesignKind::central_composite || study.design == DesignKind::box_behnken ||
             study.design == DesignKind::latin_hypercube || study.design == DesignKind::sobol;
    }

    bool uses_levels(const StudyFile &study) { return !uses_box(study) && study.design != DesignKind::table; }

    void declare_design(StudyFile &study, Section &section)
    {
      section
        .choice("Kind", study.design,
                {{"one at a time", DesignKind::one_at_a_time},
                 {"full factorial", DesignKind::full_factorial},
                 {"orthogonal array", DesignKind::orthogonal_array},
                 {"central composite", DesignKind::central_composite},
                 {"Box-Behnken", DesignKind::box_behnken},
                 {"Latin hypercube", DesignKind::latin_hypercube},
                 {"Sobol", DesignKind::sobol},
                 {"table", DesignKind::table}},
                Need::required)
        .means("Which combinations of the factors are run");
      section.text("Array", study.array, Need::optional)
        .means("Orthogonal array, L9, L27, L81 or L243 of three levels, L8 to L32 of two, L16 or L64 of four, L25 of "
               "five; a "
               "factor of one level less collapses its column")
        .only_if([&study] { return study.design == DesignKind::orthogonal_array; },
                 "the design is an orthogonal array");
      section.integer("Runs", study.runs, "", Range::at_least(1), Need::required)
        .means("How many")
        .only_if([&study] { return study.design == DesignKind::latin_hypercube || study.design == DesignKind::sobol; },
                 "the design is a Latin hypercube or Sobol's");
      section.integer("Seed", study.seed, "", Range::between(0, 1e15), Need::optional)
        .means("Of the Latin hypercube")
        .only_if([&study] { return study.design == DesignKind::latin_hypercube; }, "the design is a Latin hypercube");
      section.integer("Centres", study.centres, "", Range::between(0, 1000), Need::optional)
        .means("Runs at the centre")
        .only_if(
          [&study] { return study.design == DesignKind::central_composite || study.design == DesignKind::box_behnken; },
          "the design is a central composite or Box and Behnken's");
      section.number("Axial distance", study.axial_distance, "-", Range::between(0, 10), Need::optional)
        .means("In coded variables; 0: rotatable, 2^(factors / 4)")
        .only_if([&study] { return study.design == DesignKind::central_composite; }, "the design is central composite");
      section.file("Table", study.table_file)
        .means("Own table of runs, with a column for each factor")
        .only_if([&study] { return study.design == DesignKind::table; }, "the design is a table");
    }

    void declare_factors(StudyFile &study, Section &factors)
    {
      factors.named_sections("FACTOR", [&study](Section &opened) {
        StudyFactor &factor = study.factors.emplace_back();
        factor.name         = opened.name();
        factor.place        = opened.place();
        opened.text("Entry", factor.entries, Need::required)
          .means("Of the scene, \"Material/CPM/Cohesion\"; several between commas get the same value");
        opened.text("Levels", factor.levels_text, Need::required)
          .means("Values between commas, in the unit of the entry")
          .only_if([&study] { return uses_levels(study); }, "the design has levels");
        opened.text("Reference", factor.reference_text, Need::required)
          .means("Value while others are varied; a level of its own where it is none of them")
          .only_if([&study] { return study.design == DesignKind::one_at_a_time; }, "one factor is varied at a time");
        const Range any;
        opened.number("Lower", factor.lower, "", any, Need::required)
          .means("Value of the coded variable -1, in the unit of the entry")
          .only_if([&study] { return uses_box(study); }, "the design fills a box");
        opened.number("Upper", factor.upper, "", any, Need::required)
          .means("Value of the coded variable 1")
          .only_if([&study] { return uses_box(study); }, "the design fills a box");
      });
    }

    void declare_curve(StudyResponse &response, Section &section)
    {
      CurveReading &curve    = response.curve;
      const auto    is_curve = [&response] { return response.is_curve(); };
      section
        .choice("Curve", curve.measure,
                {{"none", CurveMeasure::none},
                 {"value", CurveMeasure::value},
                 {"peak", CurveMeasure::peak},
                 {"place of peak", CurveMeasure::place_of_peak},
                 {"area", CurveMeasure::area},
                 {"slope", CurveMeasure::slope},
                 {"hardening", CurveMeasure::hardening}},
                Need::optional)
        .means("What is read of a curve of the run's series.csv, in place of a figure")
        .only_if(is_curve, "there is no figure");
      section.text("Abscissa", curve.columns.abscissa, Need::optional).means("Column of series.csv");
      section.text("Ordinate", curve.columns.ordinate, Need::optional).means("Likewise");
      section.text("Test", curve.columns.test, Need::optional)
        .means("Rows by their column \"test\", \"compression\"; empty: all");
      section.number("From", curve.from, "", Range::at_least(0), Need::optional)
        .means("Abscissa where area or slope begin, in magnitude");
      section.number("To", curve.to, "", Range::at_least(0), Need::optional)
        .means("Abscissa of the value, or where area or slope end; 0: the end of the curve");
      section.number("Offset", curve.offset, "", Range::at_least(0), Need::optional)
        .means("By which a curve has left its straight beginning: the rest of the way to the peak, over the peak, is "
               "hardening")
        .only_if([&response] { return response.curve.measure == CurveMeasure::hardening; }, "hardening is read");
    }

    void declare_responses(StudyFile &study, Section &responses)
    {
      responses.named_sections("RESPONSE", [&study](Section &opened) {
        StudyResponse &response = study.responses.emplace_back();
        response.name           = opened.name();
        response.place          = opened.place();
        opened.text("Figure", response.figure, Need::optional)
          .means("Name among the figures of summary.json, \"compressive_strength\"");
        declare_curve(response, opened);
      });
    }

    void declare(StudyFile &study)
    {
      Section &root = *study.root;
      root.text("Kind", study.kind, Need::required).means("study");
      root.file("Base scene", study.base_scene).means("The scene that is varied");
      root.text("Output folder", study.output_folder, Need::optional)
        .means("Where results go (option -o)")
        .housekeeping();
      root.integer("Threads per run", study.threads_per_run, "", Range::between(1, 1024), Need::optional)
        .means("As many runs go on at a time as there are processors for")
        .housekeeping();
      declare_design(study, root.section("Design", "The runs"));
      declare_factors(study, root.section("Factors", "What is varied"));
      declare_responses(study, root.section("Responses", "What is read from each run"));
    }

    /** A name is a column of a table. */
    void demand_column_name(const std::string &name, const Place &place)
    {
      if (name == "run" || name.find_first_of(",[]() \t\"") != std::string::npos)
        throw base::InputError(
          place.text() + ": \"" + name +
          "\" cannot name a column of the table: no blank, comma, bracket or quote, and not \"run\".");
    }

    void validate_response(const StudyFile &study, const StudyResponse &response)
    {
      const Section      &section = *study.root->find_section("Responses")->find_section(response.name);
      const CurveReading &curve   = response.curve;
      if (response.is_curve() && curve.measure == CurveMeasure::none)
        section.refuse("Figure", "a figure is wanted, or with Curve what is read of a curve.");
      if (curve.measure == CurveMeasure::value && curve.to == 0)
        section.refuse("To", "the value of a curve is read there: it must be above zero.");
      if (curve.to > 0 && curve.from >= curve.to)
        section.refuse("To", "must be above From.");
    }

    void validate(const StudyFile &study)
    {
      if (!same_name(study.kind, "study"))
        study.root->refuse("Kind", "a study is wanted; other scenes are run by \"breccia run\".");
      if (study.base_scene.empty())
        study.root->refuse("Base scene", "a study needs a scene.");
      if (study.factors.empty() || study.responses.empty())
        throw base::InputError(study.file +
                               ": a study needs a factor (a sub-section of Factors) and a response (one of "
                               "Responses).");
      std::vector<std::string> names;
      for (const StudyFactor &factor : study.factors)
        {
          demand_column_name(factor.name, factor.place);
          names.push_back(factor.name);
          if (uses_box(study) && !(factor.lower < factor.upper))
            study.root->find_section("Factors")->find_section(factor.name)->refuse("Upper", "must be above Lower.");
        }
      for (const StudyResponse &response : study.responses)
        {
          demand_column_name(response.name, response.place);
          validate_response(study, response);
          names.push_back(response.name);
        }
      std::sort(names.begin(), names.end());
      if (const auto twice = std::adjacent_find(names.begin(), names.end()); twice != names.end())
        throw base::InputError(study.file + ": \"" + *twice + "\" names two columns of the table.");
    }
  } // namespace

  FileOf kind_of_file(const std::string &file)
  {
    for (const Assignment &assignment : read_parameter_file(file))
      if (assignment.sections.empty() && same_name(assignment.entry, "Kind"))
        return same_name(assignment.value, "study")       ? FileOf::study :
               same_name(assignment.value, "calibration") ? FileOf::calibration :
                                                            FileOf::scene;
    return FileOf::scene;
  }

  std::unique_ptr<StudyFile> declare_study()
  {
    auto study  = std::make_unique<StudyFile>();
    study->root = std::make_unique<Section>();
    declare(*study);
    return study;
  }

  std::unique_ptr<StudyFile> read_study(const std::string &file, const std::vector<std::string> &overrides)
  {
    std::unique_ptr<StudyFile> study    = declare_study();
    study->file                         = file;
    study->output_folder                = "output/" + std::filesystem::path(file).stem().string();
    std::vector<Assignment> assignments = read_parameter_file(file);
    for (Assignment &assignment : read_overrides(overrides))
      assignments.push_back(std::move(assignment));
    assign(*study->root, assignments, file);
    validate(*study);
    return study;
  }
} // namespace apps
