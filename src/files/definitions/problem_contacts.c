/* definitions/problem_contacts.c - `contacts:` of a problem file: feet and patches, listed. */
#include "contact/contacts.h"
#include "definitions/problem_reader.h"

enum { MOST_CONTACTS = 5000 };

/* index of the foot a node names; -1 when there is none */
int ambulo__read_foot(const ambulo__problem_reader *reader, const ambulo__yaml_node *node) {
  enum { MOST_FEET = 64 };
  const char *names[MOST_FEET];
  int feet = ambulo_model_foot_count(reader->model);
  if (feet > MOST_FEET) feet = MOST_FEET;
  if (feet == 0) {
    if (node)
      (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM,
                               "feet of the model file (docs/model-format.md); of an imported one: "
                               "ambulo import --foot, or --heel and --toe",
                               "the model has no feet");
    return -1;
  }
  for (int i = 0; i < feet; i++) names[i] = ambulo_model_foot(reader->model, i)->name;
  return ambulo__yaml_choice(node, names, feet, -1);
}

/* two numbers on the level ground, or three */
static void read_place(const ambulo__yaml_node *node, double place[3]) {
  int given = ambulo__yaml_is(node, AMBULO__YAML_SEQUENCE) ? ambulo__yaml_items(node) : 0;
  if (!node || given == 2 || given == 3) {
    (void)ambulo__yaml_numbers(node, given, place);
    return;
  }
  (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                           "'place' is not a list of 2 or 3 lengths: forward, left, up");
}

/* zeros are no choice; those of patches point anywhere */
static void read_normal(const ambulo__yaml_node *node, int is_foot, double normal[3]) {
  if (!ambulo__yaml_numbers(node, 3, normal)) return;
  if (normal[2] != 0.0 && ambulo__contact_normal_is_legal(normal)) return;
  if (!is_foot && (normal[0] != 0.0 || normal[1] != 0.0 || normal[2] != 0.0)) return;
  if (!is_foot) {
    (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, NULL,
                             "a normal of zeros along forward, left and up; expected a direction");
    return;
  }
  (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, NULL,
                           "a normal of (%g, %g, %g) along forward, left and up; expected one that "
                           "is up to 60 degrees from up",
                           normal[0], normal[1], normal[2]);
}

/* index of the patch a node names; 0 after an error */
static int read_patch(ambulo__problem_reader *reader, const ambulo__yaml_node *node) {
  int count = ambulo_model_patch_count(reader->model);
  if (count == 0) {
    (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, NULL, "the model has no patches");
    return 0;
  }
  const char **names = ambulo__reader_alloc(reader, (size_t)count, sizeof *names);
  for (int i = 0; names && i < count; i++) names[i] = ambulo_model_patch(reader->model, i)->name;
  return names ? ambulo__yaml_choice(node, names, count, 0) : 0;
}

/* {foot, mode} or {patch} */
static void read_effector(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                          ambulo_contact *contact) {
  static const char *const modes[] = {"heel", "flat", "toe"};
  const ambulo__yaml_node *patch = ambulo__yaml_get(node, "patch");
  if (patch && ambulo__yaml_get(node, "foot"))
    (void)ambulo__yaml_error(patch, AMBULO_E_SCHEMA, NULL,
                             "a contact of both a foot and a patch; expected one of them");
  if (patch && ambulo__yaml_get(node, "mode"))
    (void)ambulo__yaml_error(ambulo__yaml_get(node, "mode"), AMBULO_E_SCHEMA, NULL,
                             "a mode of a patch; expected one with a foot only");
  if (patch) {
    contact->foot = -1;
    contact->mode = AMBULO_CONTACT_PATCH;
    contact->patch = read_patch(reader, patch);
    return;
  }
  contact->foot = ambulo__read_foot(reader, ambulo__yaml_require(node, "foot"));
  int mode = ambulo__yaml_choice(ambulo__yaml_require(node, "mode"), modes, 3, 1);
  contact->mode = (ambulo_contact_mode)(AMBULO_CONTACT_HEEL + mode);
}

static void read_contact(ambulo__problem_reader *reader, const ambulo__yaml_node *node, void *out) {
  ambulo_contact *contact = out;
  read_effector(reader, node, contact);
  ambulo__read_members(reader, node, &ambulo__contact_members, "", contact);
  read_place(ambulo__yaml_require(node, "place"), contact->place);
  read_normal(ambulo__yaml_get(node, "normal"), contact->foot >= 0, contact->normal);
  ambulo__yaml_close(node);
}

void ambulo__read_contacts(ambulo__problem_reader *reader, const ambulo__yaml_node *list) {
  reader->definition.contacts =
      ambulo__read_items(reader, list, &ambulo__contact_members, 0, MOST_CONTACTS, read_contact,
                         &reader->definition.contact_count);
}
