# SPDX-License-Identifier: GPL-3.0-or-later
# Puts the modules of this folder, the style sheet and the page into one text, and writes it as a C++ source file (OUT), or as
# it is (HTML). Neither npm nor Python is needed: browsers run the modules as they are, and one file of them is made by taking
# the lines out that import and export. So no two modules may have a name in common at their top level; that is checked.
#   cmake -D OUT=page_template.cpp -P web/bundle.cmake
# With STUDIO it is the page of the studio instead, whose places wasm/studio.mjs fills.
cmake_minimum_required(VERSION 3.25)

# In an order in which no module needs a later one while it is loaded.
set(modules words packed nets folding backend camera webgl painter scene sheets guide print panel app start)
set(styles page)
if(STUDIO)
  list(REMOVE_ITEM modules start)
  list(INSERT modules 1 studio_words)
  list(APPEND modules wishes archive unpacker worker_backend hands edit studio start_studio)
  list(APPEND styles studio)
endif()

# Spaces that code is read by, and browsers don't need: a tenth of the script.
set(spaced "\\, " " = " " => " " === " " !== " " && " " || " " ?? " " * " " / " " += " " -= " " >= " " <= " " < " " > " " ? " " : " ": ")
# squeeze(OUT TEXT MODULE): without these, where no string of the module has them. Texts for people are all in words.js, which
# is left as it is, and in studio_words.js.
function(squeeze out text module)
  if(module MATCHES "words$")
    set(${out} "${text}" PARENT_SCOPE)
    return()
  endif()
  string(REGEX MATCHALL "\"[^\"\n]*\"" strings "${text}")
  foreach(place IN LISTS spaced)
    string(REPLACE "\\" "" place "${place}")
    string(FIND "${strings}" "${place}" at)
    if(NOT at EQUAL -1)
      string(SUBSTRING "${strings}" ${at} 40 near)
      message(FATAL_ERROR "${module}.js: a string holds '${place}', which is taken out: ...${near}; such texts stand in words.js")
    endif()
    string(STRIP "${place}" narrow)
    string(REPLACE "${place}" "${narrow}" text "${text}")
  endforeach()
  # Signs before numbers stay apart: a - -b.
  string(REGEX REPLACE " ([+-]) ([^+-])" "\\1\\2" text "${text}")
  string(REGEX REPLACE "\n(if|for|while|switch) \\(" "\n\\1(" text "${text}")
  string(REPLACE ") {" "){" text "${text}")
  # Every statement ends with its sign, so these lines may go on.
  string(REGEX REPLACE "([;{,(])\n" "\\1" text "${text}")
  set(${out} "${text}" PARENT_SCOPE)
endfunction()

set(script "\"use strict\";\n(() => {\n")
set(names "")
foreach(module IN LISTS modules)
  file(READ ${CMAKE_CURRENT_LIST_DIR}/${module}.js text)
  set(text "\n${text}")
  foreach(pattern IN ITEMS "\nexport default" "\nexport {" "\nexport \\*" "\nimport \\*" "\n(const|let|var) [[{]")
    if(text MATCHES "${pattern}")
      message(FATAL_ERROR "${module}.js: '${CMAKE_MATCH_0}' can't be bundled; export names where they are declared")
    endif()
  endforeach()
  string(REGEX MATCHALL "\nimport {[^}]*} from \"[^\"]*\";" imports "${text}")
  foreach(import IN LISTS imports)
    if(import MATCHES " as ")
      message(FATAL_ERROR "${module}.js imports under another name: ${import}")
    endif()
  endforeach()
  string(REGEX REPLACE "\nimport {[^}]*} from \"[^\"]*\";" "" text "${text}")
  string(REGEX REPLACE "\nexport " "\n" text "${text}")
  # Comments and what lines begin with go; strings over several lines hold nothing that would miss it.
  string(REGEX REPLACE "/\\*\\*[^*\n]*\\*/ ?" "" text "${text}")
  string(REGEX REPLACE "\n[ \t]*(//|/\\*\\*|\\*)[^\n]*" "" text "${text}")
  string(REGEX REPLACE "\n[ \t\n]+" "\n" text "${text}")
  squeeze(text "${text}" ${module})
  file(READ ${CMAKE_CURRENT_LIST_DIR}/${module}.js source)
  string(REGEX MATCHALL "\n(export )?(async )?(function\\*?|class|const|let|var) [A-Za-z_$][A-Za-z_$0-9]*" declared "\n${source}")
  foreach(declaration IN LISTS declared)
    string(REGEX REPLACE "^.* " "" name "${declaration}")
    if(name IN_LIST names)
      message(FATAL_ERROR "${module}.js: '${name}' is a name of another module, too")
    endif()
    list(APPEND names ${name})
  endforeach()
  string(APPEND script "${text}")
endforeach()
string(APPEND script "\n})();\n")
foreach(ending IN ITEMS "</script" "<!--")
  string(FIND "${script}" "${ending}" at)
  if(NOT at EQUAL -1)
    message(FATAL_ERROR "the script holds '${ending}', which ends it")
  endif()
endforeach()

set(style "")
foreach(sheet IN LISTS styles)
  file(READ ${CMAKE_CURRENT_LIST_DIR}/${sheet}.css text)
  string(APPEND style "${text}")
endforeach()
string(REGEX REPLACE "\n[ \t]+" "\n" style "\n${style}")
string(REGEX REPLACE "\n/\\*[^\n]*" "" style "${style}")
string(REGEX REPLACE "([{},;])\n" "\\1" style "${style}")
string(REPLACE ": " ":" style "${style}")
string(REPLACE "; " ";" style "${style}")
string(REPLACE " {" "{" style "${style}")
string(REPLACE "{ " "{" style "${style}")
string(REPLACE "; }" "}" style "${style}")
string(REPLACE ";}" "}" style "${style}")
string(REPLACE ", " "," style "${style}")

# A hash of a content security policy is base64, and CMake's is hexadecimal.
function(policy_hash out text)
  string(SHA256 digest "${text}")
  set(letters "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/")
  string(APPEND digest "00")
  set(result "")
  foreach(begin RANGE 0 60 6)
    string(SUBSTRING "${digest}" ${begin} 6 six)
    math(EXPR three "0x${six}")
    foreach(shift IN ITEMS 18 12 6 0)
      math(EXPR place "(${three} >> ${shift}) & 63")
      string(SUBSTRING "${letters}" ${place} 1 letter)
      string(APPEND result "${letter}")
    endforeach()
  endforeach()
  # 32 bytes are 43 letters and a sign that fills up.
  string(SUBSTRING "${result}" 0 43 result)
  set(${out} "${result}=" PARENT_SCOPE)
endfunction()
policy_hash(script_hash "${script}")
policy_hash(style_hash "${style}")

file(READ ${CMAKE_CURRENT_LIST_DIR}/page.html page)
foreach(place IN ITEMS "@SCRIPT@" "@STYLE@" "@SCRIPT_HASH@" "@STYLE_HASH@")
  string(FIND "${page}" "${place}" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "page.html has no ${place}")
  endif()
endforeach()
if(STUDIO)
  # Instead of a result, what makes results: the module, and the worker's script, which is made a blob.
  file(READ ${CMAKE_CURRENT_LIST_DIR}/studio.html studio)
  foreach(change IN ITEMS
      "  <meta name=\"ridgecraft-model\" content=\"@MARK@\">\n|"
      "  <meta name=\"ridgecraft-settings\" content=\"@SETTINGS@\">\n|"
      "<body>|<body class=\"studio\">\n${studio}"
      "  <script type=\"text/plain\" id=\"fold\">@FOLD@</script>\n|"
      "  <script type=\"text/plain\" id=\"sheets\">@SHEETS@</script>\n|@DATA@"
      "default-src 'none'; script-src|default-src 'none'; worker-src blob:; script-src 'wasm-unsafe-eval'"
      "@TITLE@|Ridgecraft"
      "This page shows a paper model and its sheets.|This page makes paper models of 3D models.")
    string(FIND "${change}" "|" at)
    string(SUBSTRING "${change}" 0 ${at} before)
    math(EXPR at "${at} + 1")
    string(SUBSTRING "${change}" ${at} -1 after)
    string(FIND "${page}" "${before}" found)
    if(found EQUAL -1)
      message(FATAL_ERROR "page.html has no ${before}")
    endif()
    string(REPLACE "${before}" "${after}" page "${page}")
  endforeach()
endif()
string(REGEX REPLACE "\n *<!--[^\n]*-->" "" page "${page}")
string(REGEX REPLACE "\n +" "\n" page "${page}")
string(REPLACE "@SCRIPT_HASH@" "${script_hash}" page "${page}")
string(REPLACE "@STYLE_HASH@" "${style_hash}" page "${page}")
string(REPLACE "@STYLE@" "${style}" page "${page}")
string(REPLACE "@SCRIPT@" "${script}" page "${page}")

if(DEFINED HTML)
  file(WRITE ${HTML} "${page}")
endif()
if(DEFINED OUT)
  file(WRITE ${OUT}.txt "${page}")
  file(READ ${OUT}.txt bytes HEX)
  file(REMOVE ${OUT}.txt)
  string(LENGTH "${bytes}" digits)
  math(EXPR size "${digits} / 2")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${bytes}")
  string(REGEX REPLACE "(('[^']*',)('[^']*',)('[^']*',)('[^']*',)('[^']*',)('[^']*',)('[^']*',)('[^']*',))" "\\1\n" bytes "${bytes}")
  file(WRITE ${OUT} "// Made by web/bundle.cmake; changes here are lost.
#include \"export/formats/page_template.hpp\"

namespace ridgecraft::paper {
namespace {

constexpr char bytes[] = {
${bytes}};

}  // namespace

const std::string_view page_template(bytes, ${size});

}  // namespace ridgecraft::paper
")
endif()
