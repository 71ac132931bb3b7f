# Run by every build (cmake -P): writes OUTPUT when the revision of SOURCE_DIR has changed, so that a
# report never names an older revision than the program was built from.
cmake_minimum_required(VERSION 3.25)

execute_process(COMMAND git -C ${SOURCE_DIR} describe --always --dirty --tags
                OUTPUT_VARIABLE revision OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET
                RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  set(revision "")
endif()
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT
"namespace twincraft {
extern const char* const kGitRevision;
const char* const kGitRevision = \"@revision@\";
}  // namespace twincraft
")
