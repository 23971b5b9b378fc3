# find_package(laneloom) gives laneloom::dds: readers and writers of laneloom's topics (laneloom/dds/*.hpp).
include(CMakeFindDependencyMacro)
find_dependency(Eigen3)
find_dependency(fastcdr)
find_dependency(fastrtps)
include(${CMAKE_CURRENT_LIST_DIR}/laneloomTargets.cmake)
