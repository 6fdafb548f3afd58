#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# namespaces_test.sh PROGRAMS SOURCE: four hosts on this machine, network namespaces with addresses of their own behind a
# bridge, and 16 ranks on them: one film, and a cable that is pulled out in the middle. Status 77 without VITRAIL_LONG_TESTS, and where
# there is no right to make them.
set -u
programs=$(realpath "$1") source=$(realpath "$2")
[ -n "${VITRAIL_LONG_TESTS:-}" ] || { echo "skipped: takes minutes, with VITRAIL_LONG_TESTS=1"; exit 77; }
for tool in ip mpirun; do
  command -v $tool > /dev/null || { echo "skipped: no $tool here (Debian's iproute2, openmpi-bin)"; exit 77; }
done
[ "$(id -u)" = 0 ] || { echo "skipped: network namespaces are made as root"; exit 77; }
hosts=4 ranks=16 patience=20
id=v$$
ip netns add $id-0 2> /dev/null || { echo "skipped: no network namespaces here"; exit 77; }
. "$source/scripts/mpi-environment"
folder=$(mktemp -d /tmp/vitrail-namespaces-XXXXXX)
stop() {
  for h in $(seq 0 $hosts); do
    for pid in $(ip netns pids $id-$h 2> /dev/null); do kill -9 "$pid"; done
    ip netns del $id-$h
  done 2> /dev/null
  rm -rf "$folder"
}
trap stop EXIT
fail() { echo "failed: $*"; cat "$folder"/log 2> /dev/null; exit 1; }

# Namespace 0 is the switch; in it, h$h is the cable of host $h.
ip -n $id-0 link add bridge type bridge && ip -n $id-0 link set bridge up || fail bridge
# TCP gives a host up that does not answer after some 40 s in place of a quarter of an hour: mpirun ends no sooner, and Open MPI itself
# would end the job without a name if that were before the end of our patience.
for h in $(seq $hosts); do
  ip netns add $id-$h && ip -n $id-0 link add h$h type veth peer name eth0 netns $id-$h &&
    ip -n $id-0 link set h$h master bridge up && ip -n $id-$h address add 10.77.0.$h/24 dev eth0 &&
    ip netns exec $id-$h sysctl -qw net.ipv4.tcp_retries2=6 &&
    ip -n $id-$h link set eth0 up && ip -n $id-$h link set lo up || fail "host $h"
  echo "10.77.0.$h slots=$((ranks / hosts))"
done > "$folder/hosts"

# In place of ssh: Open MPI calls it with a host and a command. Each host has its own name, so that ranks of two do not share memory.
cat > "$folder/enter" << END
#!/bin/bash
host=\$1
shift
exec ip netns exec $id-\${host##*.} unshare --uts bash -c 'hostname host-\$1; shift; eval "\$*"' enter "\${host##*.}" "\$@"
END
chmod +x "$folder/enter"
# Of host 1. By TCP alone: all of them see one /dev/shm.
mpirun="$folder/enter 10.77.0.1 OMPI_MCA_plm_rsh_agent=$folder/enter mpirun --hostfile $folder/hosts -np $ranks \
  --mca btl tcp,self --mca pml ob1 --mca btl_tcp_if_include eth0 --mca oob_tcp_if_include eth0"

cd "$folder" || exit 1
PATH=$programs:$PATH
vitrail partition "$source/examples/cornell-box/cornell-box.pbrt" -o box.vit --domains 32 --quiet || fail partition
options="--crop 0,64,0,64 --threads 1 --distribution decompose --quiet"
hash_of() { sed -n 's/.*"film_hash": "\(.*\)".*/\1/p' "$1"; }

echo "== $ranks ranks on $hosts hosts"
vitrail render box.vit -o alone.film $options --spp 16 --stats alone.json --profile profile.json || fail "one rank"
timeout 120 $mpirun $programs/vitrail render box.vit -o many.film $options --spp 16 --stats many.json --trace trace.json > log 2>&1 ||
  fail "status $?"
[ "$(hash_of alone.json)" = "$(hash_of many.json)" ] || fail "another film"
for h in $(seq $hosts); do
  [ "$(grep -c "on host-$h" trace.json)" = $((ranks / hosts)) ] || fail "ranks on host $h: $(grep -o 'rank [0-9]* on [^"]*' trace.json)"
done

echo "== a cable is pulled out"
spp=${VITRAIL_NAMESPACES_SPP:-2048}
# Homes by work: few rays are alive, and a checkpoint comes soon.
timeout 300 $mpirun $programs/vitrail render box.vit -o cut.film $options --homes profile.json --spp $spp --checkpoint-every 1 --patience $patience > log 2>&1 &
job=$!
while kill -0 $job 2> /dev/null && [ ! -e cut.film.partial ]; do sleep .1; done
[ -e cut.film.partial ] || fail "no checkpoint"
kill -0 $job 2> /dev/null || fail "it was over before: more VITRAIL_NAMESPACES_SPP"
ip -n $id-0 link set h3 down
begun=$SECONDS
wait $job
status=$?
took=$((SECONDS - begun))
echo "status $status after $took s"; cat log
[ $status != 0 ] && [ $status != 124 ] || fail "it did not end of itself"
[ $took -le $((2 * patience + 30)) ] || fail "it took $took s"
host3='\(host-3, process [0-9]*\)'
grep -Eq "ranks 8 $host3, 9 $host3, 10 $host3, 11 $host3 have not answered for $patience s" log || fail "nobody says who is silent"
[ -e cut.film ] && fail "it is finished"
for _ in $(seq $((2 * patience))); do [ -z "$(ip netns pids $id-3)" ] && break; sleep 1; done
[ -z "$(ip netns pids $id-3)" ] || fail "ranks of host 3 go on for ever"

echo "== the cable is put in again"
ip -n $id-0 link set h3 up
timeout 300 $mpirun $programs/vitrail render box.vit -o cut.film $options --spp $spp --stats cut.json > log 2>&1 || fail "status $?"
vitrail render box.vit -o whole.film $options --spp $spp --stats whole.json || fail "one rank"
[ "$(hash_of cut.json)" = "$(hash_of whole.json)" ] || fail "another film"
echo passed
