/* How a function leaves the shared library; all others stay inside.
 * SPDX-License-Identifier: MIT */
#ifndef FMU_EXPORT_H
#define FMU_EXPORT_H

#if defined _WIN32
#define FMU_EXPORT __declspec(dllexport)
#elif defined __GNUC__
#define FMU_EXPORT __attribute__((visibility("default")))
#else
#define FMU_EXPORT
#endif

#define FMU_PASTE_(a, b) a##b
#define FMU_PASTE(a, b)  FMU_PASTE_(a, b)

#endif
