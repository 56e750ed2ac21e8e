/* Lets the host read shared/structs.h once more, with other reals: forgets the guards of the structs' files. */
#undef SHARED_BVH_NODE_H
#undef SHARED_CAMERA_H
#undef SHARED_LIGHT_H
#undef SHARED_MATERIAL_H
#undef SHARED_PRIMITIVE_H
#undef SHARED_REPLAY_H
#undef SHARED_SETTINGS_H
#undef SHARED_STRUCTS_H
#undef SHARED_WORK_H
