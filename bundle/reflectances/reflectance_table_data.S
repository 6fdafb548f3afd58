// SPDX-License-Identifier: Apache-2.0
// The table as make_reflectance_table.cpp wrote it.
    .section .rodata
    .balign 64
    .globl vitrail_reflectance_table
    .type vitrail_reflectance_table, %object
vitrail_reflectance_table:
    .incbin VITRAIL_REFLECTANCE_TABLE
    .size vitrail_reflectance_table, . - vitrail_reflectance_table
    .section .note.GNU-stack, "", %progbits
