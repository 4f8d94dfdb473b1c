// job_mesh.h - the mesh of a job: made from its model, and changed afterwards
// SPDX-License-Identifier: MIT
#ifndef CLI_JOB_MESH_H
#define CLI_JOB_MESH_H

#include "cli/job.h"
#include "mesh/subdivide.h"

// Mesh the model up to a dimension (0 to 3; 3 as 2, with a notice) by the job's options, in place of the mesh it has. False after an
// error that leaves no mesh.
bool job_mesh_generate(Job *j, int dim);
// Forget the mesh.
void job_mesh_drop(Job *j);

// For a job that has a mesh. The new mesh is in as many parts as the old one; sizes at nodes are known no longer.
// Set the order of all elements, 1 to HIGH_ORDER_MAX.
void job_mesh_set_order(Job *j, int order);
// Split every element, whatever the order of the mesh, which stays.
void job_mesh_split(Job *j, Subdivision how);
// Mesh the faces once more, to be recombined; false as job_mesh_generate.
bool job_mesh_recombine(Job *j);
// Divide the mesh in n parts, or with 0 take its partition away; false after an error.
bool job_mesh_partition(Job *j, int n);

#endif
