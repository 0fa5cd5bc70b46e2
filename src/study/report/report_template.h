#pragma once

namespace rotordrop {

// The files of src/study/report, made part of the program when it is built (cmake/embed_texts.cmake).
extern const char* const report_html;
extern const char* const report_css;
extern const char* const figures_js;
extern const char* const report_js;
// Those of src/study/many/report, the page of a study.
extern const char* const study_css;
extern const char* const study_js;

}  // namespace rotordrop
