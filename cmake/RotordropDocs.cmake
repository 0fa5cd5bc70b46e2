# Target docs: the documents as HTML pages, with the reference of all parameters and commands as this build has them.
set(ROTORDROP_HTML ${CMAKE_BINARY_DIR}/html)
add_custom_target(docs
  COMMAND /usr/bin/python3 ${CMAKE_SOURCE_DIR}/docs/build.py --program $<TARGET_FILE:rotordrop> --output ${ROTORDROP_HTML}
  DEPENDS rotordrop VERBATIM COMMENT "Documents as HTML")
