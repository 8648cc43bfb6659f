# Makes a C++ file of the page's parts: cmake -DPAGE=FOLDER -DSCRIPTS=A.js,B.js -DOUT=FILE -P embed.cmake
string(REPLACE "," ";" scripts "${SCRIPTS}")
file(READ ${PAGE}/page.html frame)
file(READ ${PAGE}/page.css style)
set(script "")
foreach(name IN LISTS scripts)
  file(READ ${PAGE}/${name} text)
  string(APPEND script "// ${name}\n" "${text}")
endforeach()
file(WRITE ${OUT} "#include \"apps/plot/page_parts.hpp\"\n\nnamespace coastmesh {\n"
  "const std::string_view kPageFrame = R\"=page=(" "${frame}" ")=page=\";\n"
  "const std::string_view kPageStyle = R\"=page=(" "${style}" ")=page=\";\n"
  "const std::string_view kPageScript = R\"=page=(" "${script}" ")=page=\";\n"
  "}  // namespace coastmesh\n")
