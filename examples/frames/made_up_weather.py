#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Prints a weather file (EPW) that nobody measured, to try `vitrail year`: every third day is clear, the others are overcast.

    ./made_up_weather.py --place 48.86,2.35 --zone 1 > made-up.epw

Real ones are free for most towns, at climate.onebuilding.org for example.
"""

import argparse
import datetime
import math


def sine_of_elevation(latitude_deg, longitude_deg, zone, day, hour):
    """By the sun's declination alone, without the equation of time."""
    declination = math.radians(-23.44) * math.cos(math.tau * (day + 10) / 365)
    angle = math.radians(15 * (hour - zone - 12) + longitude_deg)
    latitude = math.radians(latitude_deg)
    return math.sin(latitude) * math.sin(declination) + math.cos(latitude) * math.cos(declination) * math.cos(angle)


def lux_of(sine, clear):
    """Of the sun across its direction, and of the sky on the ground."""
    if sine <= 0.02:
        return 0, 0
    return (105_000 * math.exp(-0.21 / sine), 14_000 * math.sqrt(sine)) if clear else (0, 21_000 * sine)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--place", default="48.86,2.35", help="latitude,longitude in degrees")
    parser.add_argument("--zone", type=float, default=1, help="hours from UTC")
    args = parser.parse_args()
    latitude, longitude = (float(number) for number in args.place.split(","))
    print(f"LOCATION,Made up,-,-,Made up,000000,{latitude:g},{longitude:g},{args.zone:g},0")
    for name in ("DESIGN CONDITIONS,0", "TYPICAL/EXTREME PERIODS,0", "GROUND TEMPERATURES,0", "HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0",
                 "COMMENTS 1,nobody measured this", "COMMENTS 2,", "DATA PERIODS,1,1,Data,Sunday,1/1,12/31"):  # fmt: skip
        print(name)
    for day in range(1, 366):
        date = datetime.date(2001, 1, 1) + datetime.timedelta(days=day - 1)
        for hour in range(24):
            sine = sine_of_elevation(latitude, longitude, args.zone, day, hour + 0.5)
            sun, sky = lux_of(sine, day % 3 == 0)
            watts = f"0,0,0,{max(0, sine) * sun / 100 + sky / 120:.0f},{sun / 100:.0f},{sky / 120:.0f}"
            lux = f"{max(0, sine) * sun + sky:.0f},{sun:.0f},{sky:.0f}"
            print(f"2001,{date.month},{date.day},{hour + 1},60,-,15,10,70,101325,{watts},{lux},0,0,0,0,0,0")


if __name__ == "__main__":
    main()
