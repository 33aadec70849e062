/* Definitions that every scene has: the text in the function language. */
#ifndef CAL_SCENE_NAMES_H
#define CAL_SCENE_NAMES_H

/* Texts that go one after the other; a null pointer ends them. */
extern const char *const cal_scene_names[];

#endif
