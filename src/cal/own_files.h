/* Function files that scenes name and that come with Radiance: our own definitions, for where there are none along
 * RAYPATH. */
#ifndef CAL_OWN_FILES_H
#define CAL_OWN_FILES_H

/* The definitions of the file of that name, with or without .cal; null where there are none. */
const char *cal_own_file(const char *name);

#endif
