#pragma once

namespace rotordrop {

// The files of src/study/report, made part of the program when it is built (cmake/embed_texts.cmake).
extern const char* const report_html;
extern const char* const report_css;
extern const char* const page_js;  // of all pages, before their own
extern const char* const figures_js;
extern const char* const drop_js;
extern const char* const machine_js;
extern const char* const waterfall_js;
extern const char* const report_js;
// Those of src/study/many/answers, the page of a study.
extern const char* const study_css;
extern const char* const study_js;
// Figures that the pages of studies and of measured series share, and the page of measured series.
extern const char* const chart_js;
extern const char* const measured_js;

}  // namespace rotordrop
