/* Loading scenes: what is accepted, and what is refused with which words. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "scene/scene.h"
#include "support/scene_text.h"

static void assert_refused(const char *text, const char *place_and_name, const char *reason) {
    graze_scene *scene = scene_from_text(text);
    graze_scene_destroy(scene);
    if (scene || !strstr(messages, place_and_name) || !strstr(messages, reason))
        fail_msg("%s\nwanted '%s' and '%s', got: %s", text, place_and_name, reason, scene ? "no error" : messages);
}

static void unsupported_types_are_refused_by_name(void **state) {
    (void)state;
    assert_refused("\nvoid aBSDF pane 5 a.xml 0 0 1 . 0 0\npane sphere s 0 0 4 0 0 0 1\n", ":2:1: aBSDF pane",
                   "not supported");
    assert_refused("void BSDF d 6 0 a.xml 0 0 1 . 0 0 d sphere s 0 0 4 0 0 0 1\n", ":1:1: BSDF d", "not supported");
    assert_refused("void plastic m 0 0 5 1 1 1 0 0\nm instance i 1 other.oct 0 0\n", ":2:1: instance i",
                   "cannot find octree file \"other.oct\"");
    assert_refused("void specfile p 1 noise 0 0\np plastic m 0 0 5 1 1 1 0 0 m sphere s 0 0 4 0 0 0 1\n",
                   ":1:1: specfile p", "not supported");
}

static void assert_warned(const char *text, const char *where, const char *what) {
    graze_scene *scene = scene_from_text(text);
    if (!scene || !strstr(messages, where) || !strstr(messages, what))
        fail_msg("%s: %s", text, messages);
    graze_scene_destroy(scene);
}

static void shapes_without_a_size_are_left_out(void **state) {
    (void)state;
    assert_warned("void plastic p 0 0 5 1 1 1 0 0 p sphere s 0 0 4 0 0 0 1e-7", ":1:32: sphere s",
                  "zero radius; the surface is left out");
    assert_warned("void plastic p 0 0 5 1 1 1 0 0 p bubble s 0 0 4 0 0 0 0", ":1:32: bubble s",
                  "zero radius; the surface is left out");
}

static void surfaces_without_a_material_are_told(void **state) {
    (void)state;
    assert_warned("void sphere s 0 0 4 0 0 0 1\n", ":1:1: sphere s", "no material");
    assert_warned("void brightfunc p 2 1 . 0 0 void plastic a 0 0 5 1 1 1 0 0 void mixfunc m 4 a p .5 . 0 0 "
                  "m sphere s 0 0 4 0 0 0 1 p sphere t 0 0 4 3 0 0 1",
                  ":1:1: brightfunc p", "there is no material behind it");
    assert_warned("void mixfunc m 4 void void .5 . 0 0 m sphere s 0 0 4 0 0 0 1", ":1:1: mixfunc m",
                  "there is no material behind it");
}

/* Words that Radiance passes over. */
static void idle_words_are_told(void **state) {
    (void)state;
    assert_warned("void plastic2 m 7 1 0 0 . idle -rx 9 0 6 1 1 1 0 .1 .2 m sphere s 0 0 4 0 0 0 1", ":1:1: plastic2 m",
                  "its string argument 5, 'idle', has no meaning");
    assert_warned("void plastic2 m 7 1 Px 0 . idle -rx 9 0 6 1 1 1 0 .1 .2 m sphere s 0 0 4 0 0 0 1",
                  ":1:1: plastic2 m", "its string argument 5, 'idle', has no meaning");
}

static void lights_are_checked(void **state) {
    (void)state;
    assert_warned("void light l 1 x 0 3 1 1 1 l sphere s 0 0 4 0 0 0 1\n", ":1:1: light l", "\"x\", has no meaning");
    assert_refused("void light l 0 0 3 1 -1 1 l sphere s 0 0 4 0 0 0 1\n", "light l", "negative");
    assert_refused("void plastic p 0 0 5 1 1e11 1 0 0 p sphere s 0 0 4 0 0 0 1\n", "plastic p",
                   "real argument 2 is above 1e10");
    assert_refused("void spotlight l 0 0 7 1 1 1 0 0 0 1 l sphere s 0 0 4 0 0 0 1\n", "spotlight l", "angle");
    assert_refused("void spotlight l 0 0 7 1 1 1 10 0 0 0 l sphere s 0 0 4 0 0 0 1\n", "spotlight l", "null");
    assert_refused("void light l 0 0 3 1 1 1 l source s 0 0 4 0 0 0 1\n", "source s", "direction");
    assert_refused("void light l 0 0 3 1 1 1 l source s 0 0 4 0 0 1 0\n", "source s", "angle");
    assert_warned("void light l 0 0 3 1 1 1 l source s 0 0 4 0 0 1 400\n", ":1:26: source s",
                  "an angle of 400 degrees, above 360, is one of 320 degrees, as in Radiance");
    assert_warned("void light l 0 0 3 1 1 1 l source s 0 0 4 0 0 1 360.0001\n", ":1:26: source s",
                  "an angle of 360.0001 degrees, above 360, is one of 359.9999 degrees");
    assert_warned("void spotlight l 0 0 7 1 1 1 1000 0 0 1 l sphere s 0 0 4 0 0 0 1\n", ":1:1: spotlight l",
                  "one of 280 degrees");
}

static void illums_are_checked(void **state) {
    (void)state;
    assert_warned("void plastic a 0 0 5 1 1 1 0 0 void illum i 2 a b 0 3 1 1 1 i sphere s 0 0 4 0 0 0 1\n",
                  ":1:32: illum i", "string argument 2, \"b\", has no meaning");
    assert_warned("void illum i 1 a 0 3 1 1 1 i sphere s 0 0 4 0 0 0 1\n", ":1:1: illum i",
                  "no modifier 'a' before it: as in Radiance, that is void");
    assert_refused("void light l 0 0 3 1 1 1 void illum i 1 l 0 3 1 1 1 i sphere s 0 0 4 0 0 0 1\n", "illum i",
                   "seen as l, which shines");
    assert_refused("void plastic p 0 0 3 1 1 1 void illum i 1 p 0 3 1 1 1 i sphere s 0 0 4 0 0 0 1\n", "plastic p",
                   "real");
}

static void prisms_are_checked(void **state) {
    (void)state;
    assert_refused("void prism1 i 4 1 Dx Dy Dz 0 0 i sphere s 0 0 4 0 0 0 1\n", ":1:1: prism1 i", "string");
    assert_refused("void prism1 i 5 1 Dx Dy bad . 0 0 i sphere s 0 0 4 0 0 0 1\n", ":1:1: prism1 i", "bad");
    graze_scene *scene = scene_from_text("void prism1 i 5 1 DxA Dy Dz . 0 0 i sphere s 0 0 4 0 0 0 1");
    assert_non_null(scene);
    assert_non_null(strstr(messages, "prism1 i: DxA, DyA and DzA are 0"));
    graze_scene_destroy(scene);
}

static void alternates_of_mirrors_are_checked(void **state) {
    (void)state;
    assert_refused("void mirror i 2 a b 0 3 1 1 1 i sphere s 0 0 4 0 0 0 1\n", ":1:1: mirror i", "1 string");
    assert_warned("void mirror i 1 a 0 3 1 1 1 i sphere s 0 0 4 0 0 0 1\n", ":1:1: mirror i",
                  "no modifier 'a' before it: as in Radiance, that is void");
    assert_refused("void glow l 0 0 4 1 1 1 0 void mirror i 1 l 0 3 1 1 1 i sphere s 0 0 4 0 0 0 1\n", "mirror i",
                   "seen as l, which shines");
}

static void antimatter_is_checked(void **state) {
    (void)state;
    assert_refused("void antimatter i 0 0 0 i sphere s 0 0 4 0 0 0 1\n", ":1:1: antimatter i", "string");
    assert_warned("void antimatter i 1 a 0 0 i sphere s 0 0 4 0 0 0 1\n", ":1:1: antimatter i",
                  "no modifier 'a' before");
    assert_refused(
        "void light l 0 0 3 1 1 1 void antimatter i 2 void l 0 0 i sphere s 0 0 4 0 0 0 1 l sphere t 0 0 4 3 "
        "0 0 1\n",
        "antimatter i", "cuts l, which shines");
    assert_refused("void antimatter j 1 void 0 0 void antimatter i 1 j 0 0 i sphere s 0 0 4 0 0 0 1\n", "antimatter i",
                   "names j, which is mist or antimatter");
    assert_refused("void antimatter j 1 void 0 0 void antimatter i 2 void j 0 0 i sphere s 0 0 4 0 0 0 1\n",
                   "antimatter i", "names j, which is mist or antimatter");
    graze_scene *scene = scene_from_text("void antimatter i 2 void no 0 0 i sphere s 0 0 4 0 0 0 1");
    assert_non_null(scene);
    assert_non_null(strstr(messages, "antimatter i: there is no modifier 'no' before it, which it could cut"));
    graze_scene_destroy(scene);
}

/* As many as there are bits; the next one is refused by its name and place. */
static void antimatters_and_mists_are_counted(void **state) {
    (void)state;
    static const struct {
        const char *type, *arguments, *place, *reason;
        int most;
    } cases[] = {
        {"antimatter", "1 void 0 0", ":65:1: antimatter m64", "no more than 64 materials of antimatter", 64},
        {"mist", "0 0 3 1 1 1", ":33:1: mist m32", "no more than 32 materials of mist", 32},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        static char text[10000];
        for (int more = 0; more <= 1; more++) {
            char *end = text;
            for (int k = 0; k < cases[i].most + more; k++) {
                size_t left = sizeof text - (size_t)(end - text);
                end += snprintf(end, left, "void %s m%d %s m%d sphere s%d 0 0 4 %d 0 0 .3\n", cases[i].type, k,
                                cases[i].arguments, k, k, k);
            }
            graze_scene *scene = more ? NULL : scene_from_text(text);
            if (more)
                assert_refused(text, cases[i].place, cases[i].reason);
            else if (!scene)
                fail_msg("%s", messages);
            graze_scene_destroy(scene);
        }
    }
}

/* Lights are sampled in mirrors that are whole, and those that are cut are found by reflection. */
static void mirrors_that_are_cut_are_not_sampled(void **state) {
    (void)state;
    graze_scene *scene = scene_from_text(
        "void mirror cut 0 0 3 1 1 1 void mirror whole 0 0 3 1 1 1 void antimatter a 2 void cut 0 0 "
        "cut ring r 0 0 8 0 0 0 0 0 1 0 1 whole ring s 0 0 8 3 0 0 0 0 1 0 1 a sphere t 0 0 4 0 0 0 .5");
    assert_non_null(scene);
    assert_int_equal(scene->mirror_surface_count, 1);
    assert_string_equal(scene->primitives[scene->surfaces[scene->mirror_surfaces[0]].primitive].id, "s");
    for (size_t i = 0; i < scene->surface_count; i++)
        assert_true(scene->surfaces[i].mirrors == ((int)i == scene->mirror_surfaces[0]));
    graze_scene_destroy(scene);
}

static void mist_is_checked(void **state) {
    (void)state;
    assert_refused("void mist i 0 0 2 1 1 i sphere s 0 0 4 0 0 0 1\n", ":1:1: mist i", "0, 3, 6 or 7");
    assert_refused("void mist i 0 0 3 1 -1 1 i sphere s 0 0 4 0 0 0 1\n", ":1:1: mist i", "argument 2");
    assert_refused("void mist i 0 0 6 1 1 1 .5 .5 2 i sphere s 0 0 4 0 0 0 1\n", ":1:1: mist i", "argument 6");
    assert_refused("void mist i 0 0 7 1 1 1 .5 .5 1 1 i sphere s 0 0 4 0 0 0 1\n", "mist i", "eccentricity");
    assert_refused("void brightfunc p 2 Px . 0 0 p mist i 0 0 3 1 1 1 i sphere s 0 0 4 0 0 0 1\n", "mist i",
                   "patterns on mist");
    graze_scene *scene = scene_from_text("void light l 0 0 3 1 1 1 l sphere a 0 0 4 5 0 0 1 "
                                         "void mist i 4 a b a m>a 0 3 1 1 1 i sphere s 0 0 4 0 0 0 1");
    assert_non_null(scene);
    assert_non_null(strstr(messages, "mist i: there is no light 'b'"));
    assert_non_null(strstr(messages, "mist i: what a mirror or a prism throws, as 'm>a', is not scattered"));
    assert_non_null(strstr(messages, "mist i: light 'a' is listed twice"));
    graze_scene_destroy(scene);
}

/* What is inside of their surfaces tells, so nothing on a surface can stand for them. */
static void mist_and_antimatter_stand_alone(void **state) {
    (void)state;
    const char *volumes[] = {"void mist v 0 0 3 1 1 1 ", "void antimatter v 1 void 0 0 "};
    const char *users[] = {
        "void illum i 1 v 0 3 1 1 1 ",       "void mirror i 1 v 0 3 1 1 1 ",
        "void antimatter i 1 v 0 0 ",        "void antimatter i 2 void v 0 0 ",
        "void mixfunc i 4 v void .5 . 0 0 ", "void plastic p 0 0 5 1 1 1 0 0 void mixfunc i 4 p v .5 . 0 0 "};
    for (size_t v = 0; v < 2; v++)
        for (size_t u = 0; u < sizeof users / sizeof *users; u++) {
            char text[200];
            snprintf(text, sizeof text, "%s%si sphere s 0 0 4 0 0 0 1\n", volumes[v], users[u]);
            assert_refused(text, " i: ", "mist or antimatter");
        }
}

static void all_mistakes_are_told_at_once(void **state) {
    (void)state;
    const char *text = "void aBSDF a 5 a.xml 0 0 1 . 0 0 a sphere s 0 0 4 0 0 0 1\nvoid BSDF b 6 0 a.xml 0 0 1 . 0 0 b "
                       "sphere t 0 0 4 0 0 0 1\n";
    assert_refused(text, "aBSDF a", "BSDF b");
}

static void unused_modifiers_do_no_harm(void **state) {
    (void)state;
    graze_scene *scene =
        scene_from_text("void glass a 0 0 3 1 1 1\nvoid plastic m 0 0 5 1 1 1 0 0 m sphere s 0 0 4 0 0 0 1\n");
    assert_non_null(scene);
    assert_int_equal(scene->surface_count, 1);
    assert_int_equal(scene->material_count, 1);
    assert_int_equal(scene->light_count, 0);
    graze_scene_destroy(scene);
}

static void sources_come_last_and_lights_before_glows(void **state) {
    (void)state;
    graze_scene *scene =
        scene_from_text("void glow g 0 0 4 1 1 1 0 g source sky 0 0 4 0 0 1 180\nvoid light l 0 0 3 1 1 1\n"
                        "l source sun 0 0 4 0 0 1 .5 l sphere lamp 0 0 4 0 0 0 1\n"
                        "void light dark 0 0 3 0 0 0 dark sphere none 0 0 4 0 0 9 1\n");
    assert_non_null(scene);
    assert_int_equal(scene->light_count, 3);
    assert_int_equal(scene->first_source, 1);
    assert_string_equal(scene_name(scene, scene->lights[0].primitive), "lamp");
    assert_string_equal(scene_name(scene, scene->lights[1].primitive), "sun");
    assert_string_equal(scene_name(scene, scene->lights[2].primitive), "sky");
    assert_int_equal(scene->surfaces[1].light, -1);
    graze_scene_destroy(scene);
}

static void a_surface_across_its_orientation_is_warned_about(void **state) {
    (void)state;
    graze_scene *scene = scene_from_text("void metal2 m 4 0 0 1 . 0 6 1 1 1 .5 .1 .2\n"
                                         "m ring r 0 0 8 0 0 0 0 0 1 0 1 m ring s 0 0 8 0 0 0 0 1 0 0 1\n");
    assert_non_null(scene);
    assert_non_null(strstr(messages, ":2:1: ring r"));
    assert_null(strstr(messages, "ring s"));
    graze_scene_destroy(scene);
}

/* The models that materials a, b and c, an alias of a, have after the choices. */
static void assert_models(const graze_model_choice *choices, size_t count, const graze_brdf_model *expected) {
    const graze_scene_settings settings = {.models = choices, .model_count = count};
    graze_scene *scene =
        scene_from_text_with("void plastic a 0 0 5 1 1 1 .1 .1\nvoid metal2 b 4 1 0 0 . 0 6 1 1 1 .1 .1 .2\n"
                             "void alias c a\nvoid light l 0 0 3 1 1 1\n"
                             "a sphere a 0 0 4 0 0 0 1\nb sphere b 0 0 4 4 0 0 1\n"
                             "c sphere c 0 0 4 8 0 0 1\nl sphere l 0 0 4 0 4 0 1\n",
                             &settings);
    if (!scene) {
        fail_msg("%s", messages);
        return;
    }
    for (size_t i = 0; i < 3; i++) {
        assert_string_equal(scene_name(scene, scene->surfaces[i].primitive), ((const char *[]){"a", "b", "c"}[i]));
        assert_int_equal(scene->materials[scene->surfaces[i].material].reflector.model, expected[i]);
    }
    graze_scene_destroy(scene);
}

static void models_are_chosen_most_specifically(void **state) {
    (void)state;
    const graze_brdf_model gmd = GRAZE_BRDF_GMD, ward = GRAZE_BRDF_WARD, duer = GRAZE_BRDF_WARD_DUER,
                           neumann = GRAZE_BRDF_WARD_NEUMANN;
    const graze_model_choice all[] = {{NULL, ward}, {NULL, duer}};
    const graze_model_choice named[] = {{"a", ward}, {"b", neumann}, {NULL, duer}, {"b", gmd}};
    const graze_model_choice alias[] = {{"c", ward}, {"a", neumann}};
    assert_models(NULL, 0, (const graze_brdf_model[]){gmd, gmd, gmd});
    assert_models(all, 1, (const graze_brdf_model[]){ward, ward, ward});
    assert_models(all, 2, (const graze_brdf_model[]){duer, duer, duer});
    assert_models(named, 3, (const graze_brdf_model[]){ward, neumann, ward});
    assert_models(named, 4, (const graze_brdf_model[]){ward, gmd, ward});
    assert_models(alias, 2, (const graze_brdf_model[]){neumann, gmd, ward});
}

static void models_are_for_materials_that_reflect(void **state) {
    (void)state;
    const char *text = "void plastic p 0 0 5 1 1 1 .1 .1\nvoid light l 0 0 3 1 1 1\np sphere s 0 0 4 0 0 0 1\n";
    const struct {
        graze_model_choice choice;
        const char *reason;
    } cases[] = {{{"q", GRAZE_BRDF_WARD}, "no material 'q'"},
                 {{"l", GRAZE_BRDF_WARD}, ":2:1: light l: has no reflectance model"},
                 {{"s", GRAZE_BRDF_WARD}, ":3:1: sphere s: has no reflectance model"},
                 {{"p", (graze_brdf_model)4}, "unknown reflectance model 4"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const graze_scene_settings settings = {.models = &cases[i].choice, .model_count = 1};
        assert_null(scene_from_text_with(text, &settings));
        if (!strstr(messages, cases[i].reason))
            fail_msg("wanted '%s', got: %s", cases[i].reason, messages);
    }
}

static void nothing_is_loaded_for_patterns_that_are_not_there(void **state) {
    (void)state;
    graze_scene *scene = scene_from_text("void brightfunc unused 2 Px none.cal 0 0 void plastic m 0 0 5 1 1 1 0 0 "
                                         "m sphere s 0 0 4 0 0 0 1");
    if (!scene)
        fail_msg("%s", messages);
    else
        assert_null(scene->modifiers);
    graze_scene_destroy(scene);
}

static void mixtures_are_checked(void **state) {
    (void)state;
    assert_refused("void mist d 0 0 0 void mixfunc m 4 d void .5 . 0 0 m sphere s 0 0 4 0 0 0 1", ":1:19: mixfunc m",
                   "a mixture with mist or antimatter is not supported");
    assert_refused("void glow g 0 0 4 1 1 1 0 void light l 0 0 3 1 1 1 void mixfunc m 4 g l .5 . 0 0 "
                   "m sphere s 0 0 4 0 0 0 1",
                   "mixfunc m", "a mixture of two materials that shine is not supported");
    assert_warned("void glow g 0 0 4 1 1 1 0 void mixfunc m 4 g void .5 . 0 0 m source s 0 0 4 0 0 1 9",
                  ":1:60: source s", "a source whose material is a mixture does nothing, as in Radiance");
}

/* One light for all surfaces, which is none that is sampled; lamps are told of, a glow that is seen only anyway is not.
 */
static void mixtures_that_shine_are_seen_only(void **state) {
    (void)state;
    const char *text = "void light l 0 0 3 1 2 1 void plastic p 0 0 5 1 1 1 0 0 void mixfunc m 4 %s p .5 . 0 0 "
                       "void mixfunc n 4 m void .5 . 0 0 n sphere s 0 0 4 0 0 0 1 m sphere t 0 0 4 3 0 0 1 "
                       "l sphere lamp 0 0 4 9 0 0 1";
    char with[400];
    snprintf(with, sizeof with, text, "l");
    graze_scene *scene = scene_from_text(with);
    assert_non_null(scene);
    assert_int_equal(scene->light_count, 1);
    assert_int_equal(scene->seen_light_count, 1);
    assert_int_equal(scene->surfaces[0].light, 1);
    assert_int_equal(scene->surfaces[1].light, 1);
    assert_int_equal(scene->surfaces[2].light, 0);
    assert_true(scene->lights[1].only_seen && scene->lights[1].radiance.g == 2);
    assert_non_null(strstr(messages, "sphere s: shines, but lights nothing: what is in a mixture is seen only"));
    assert_null(strstr(messages, "sphere t"));
    graze_scene_destroy(scene);
    scene = scene_from_text("void glow g 0 0 4 1 1 1 0 void mixfunc m 4 g void .5 . 0 0 m sphere s 0 0 4 0 0 0 1");
    assert_non_null(scene);
    assert_string_equal(messages, "");
    graze_scene_destroy(scene);
}

/* So many surfaces that threads share them; a few are left out, or not quite right. */
static char *many_surfaces(int count) {
    char *text = malloc(64 * (size_t)count + 100);
    assert_non_null(text);
    size_t length = (size_t)sprintf(text, "void plastic p 0 0 5 1 1 1 0 0\n");
    for (int i = 0; i < count; i++) {
        if (i % 5000 == 1)
            length += (size_t)sprintf(text + length, "p polygon x%d 0 0 9 0 0 0 1 1 1 2 2 2\n", i);
        else if (i % 5000 == 2)
            length += (size_t)sprintf(text + length, "p sphere s%d 0 0 4 %d 0 0 -.1\n", i, i);
        else if (i % 3)
            length += (size_t)sprintf(text + length, "p sphere s%d 0 0 4 %d 0 0 .1\n", i, i);
        else /* concave */
            length += (size_t)sprintf(text + length, "p polygon v%d 0 0 12 %d 0 0 0 1 0 -1 0 0 0 9 0\n", i, i + 1);
    }
    return text;
}

static void threads_make_the_same_surfaces(void **state) {
    (void)state;
    enum { COUNT = 21000 };
    char *text = many_surfaces(COUNT);
    graze_scene *one = scene_from_text(text), *two = scene_from_text_with(text, &(graze_scene_settings){.threads = 2});
    free(text);
    assert_non_null(one);
    assert_non_null(two);
    assert_int_equal(one->surface_count, COUNT - 5);
    assert_int_equal(two->surface_count, COUNT - 5);
    for (size_t i = 0; i < one->surface_count; i++) {
        const shape *a = &one->shapes[i], *b = &two->shapes[i];
        assert_int_equal(one->surfaces[i].primitive, two->surfaces[i].primitive);
        assert_int_equal(a->kind, b->kind);
        if (a->kind == SHAPE_SPHERE) {
            assert_int_equal(a->inward, b->inward);
            assert_true(vec3_is_same(a->sphere.center, b->sphere.center));
        } else {
            assert_int_equal(a->polygon.triangle_count, 2);
            assert_memory_equal(a->polygon.triangles, b->polygon.triangles, 2 * sizeof *a->polygon.triangles);
        }
    }
    /* Of the second scene, in the text's order. */
    const char *at = messages;
    for (int i = 0; i < COUNT; i += 5000) {
        char left_out[64], turned[64];
        snprintf(left_out, sizeof left_out, ":%d:1: polygon x%d: zero area", i + 3, i + 1);
        snprintf(turned, sizeof turned, ":%d:1: sphere s%d: negative radius", i + 4, i + 2);
        at = strstr(at, left_out);
        assert_non_null(at);
        at = strstr(at, turned);
        assert_non_null(at);
        assert_null(strstr(at + 1, turned));
    }
    graze_scene_destroy(one);
    graze_scene_destroy(two);
}

static void an_empty_scene_is_a_scene(void **state) {
    (void)state;
    graze_scene *scene = scene_from_text("# nothing here\n");
    assert_non_null(scene);
    graze_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(unsupported_types_are_refused_by_name),
        cmocka_unit_test(shapes_without_a_size_are_left_out),
        cmocka_unit_test(surfaces_without_a_material_are_told),
        cmocka_unit_test(idle_words_are_told),
        cmocka_unit_test(lights_are_checked),
        cmocka_unit_test(illums_are_checked),
        cmocka_unit_test(prisms_are_checked),
        cmocka_unit_test(alternates_of_mirrors_are_checked),
        cmocka_unit_test(antimatter_is_checked),
        cmocka_unit_test(antimatters_and_mists_are_counted),
        cmocka_unit_test(mirrors_that_are_cut_are_not_sampled),
        cmocka_unit_test(mist_is_checked),
        cmocka_unit_test(mist_and_antimatter_stand_alone),
        cmocka_unit_test(all_mistakes_are_told_at_once),
        cmocka_unit_test(unused_modifiers_do_no_harm),
        cmocka_unit_test(sources_come_last_and_lights_before_glows),
        cmocka_unit_test(a_surface_across_its_orientation_is_warned_about),
        cmocka_unit_test(models_are_chosen_most_specifically),
        cmocka_unit_test(models_are_for_materials_that_reflect),
        cmocka_unit_test(nothing_is_loaded_for_patterns_that_are_not_there),
        cmocka_unit_test(mixtures_are_checked),
        cmocka_unit_test(mixtures_that_shine_are_seen_only),
        cmocka_unit_test(threads_make_the_same_surfaces),
        cmocka_unit_test(an_empty_scene_is_a_scene),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
